#include "numbers.hpp"
#include <apps/elvis/view/scene/items.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace elvis::view {

namespace {

std::string digits(double number, int n_digits) {
    char text[40];
    std::snprintf(text, sizeof text, "%.*g", n_digits, number);
    return text;
}

/** One row a plane or boundary, and one an isovalue; none for what is not integrated. */
std::vector<NumbersQuestion> rows_of(const Scene& scene, std::size_t index, const std::string& scenes_field) {
    const Json& surface = scene["surfaces"][index];
    const std::string type = surface["type"], own = surface.value("field", scenes_field);
    NumbersQuestion question;
    question.of = item_label(scene, {ItemKind::surface, index});
    question.field = own;
    question.is_clipped = surface.contains("clip");
    if (type == "boundary") {
        question.domain = ELVIS_DOMAIN_BOUNDARY;
        question.groups = surface.value("groups", question.groups);
        return {question};
    }
    if (type == "plane") {
        question.domain = ELVIS_DOMAIN_PLANE;
        question.plane = surface["plane"];
        return {question};
    }
    if (type != "isosurface") {
        return {};
    }
    std::vector<NumbersQuestion> rows;
    question.domain = ELVIS_DOMAIN_ISOSURFACE;
    question.level_field = own;
    question.field = surface.value("color_field", own);
    for (const double value : surface["values"]) {
        question.isovalue = value;
        question.of = std::string("Isosurface ").append(own).append(" = ").append(digits(value, 6));
        rows.push_back(question);
    }
    return rows;
}

void append_cell(std::string& text, const std::string& cell) {
    text += '\t';
    // Names and messages of others may hold anything.
    std::ranges::replace_copy_if(
        cell, std::back_inserter(text), [](char c) { return c == '\t' || c == '\n'; }, ' ');
}

void append_extremum(std::string& text, double value, const double position[3]) {
    append_cell(text, digits(value, 17));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        append_cell(text, std::isfinite(position[axis]) ? digits(position[axis], 17) : std::string());
    }
}

} // namespace

std::vector<NumbersQuestion> questions_of(const Scene& scene, const VolumeFacts& volume) {
    if (volume.fields.empty() && !scene.contains("field")) {
        return {};
    }
    const std::string scenes_field =
        said<std::string>(scene, "field").value_or(volume.fields.empty() ? "" : volume.fields[0].name);
    std::vector<NumbersQuestion> of_surfaces;
    for (std::size_t index = 0; index < part_of(scene, "surfaces").size(); ++index) {
        if (is_shown(scene, {ItemKind::surface, index}) && volume.dimension == 3) {
            const std::vector<NumbersQuestion> rows = rows_of(scene, index, scenes_field);
            of_surfaces.insert(of_surfaces.end(), rows.begin(), rows.end());
        }
    }
    std::vector<NumbersQuestion> questions;
    const auto add_volume = [&](const std::string& field) {
        if (std::ranges::none_of(questions, [&](const NumbersQuestion& other) { return other.field == field; })) {
            NumbersQuestion question;
            question.of = "Volume";
            question.field = field;
            questions.push_back(question);
        }
    };
    add_volume(scenes_field);
    for (const NumbersQuestion& question : of_surfaces) {
        add_volume(question.field);
    }
    const Json& rendering = part_of(scene, "volume_rendering");
    if (rendering.value("visible", true) && rendering.contains("field")) {
        add_volume(rendering["field"]);
    }
    questions.insert(questions.end(), of_surfaces.begin(), of_surfaces.end());
    for (NumbersQuestion& question : questions) {
        question.time_step = time_step_of(scene);
        question.warp = part_of(scene, "warp");
        question.is_clipped = question.is_clipped || scene.contains("threshold");
    }
    return questions;
}

std::string remark_of(const Numbers& row) {
    std::string text = row.error;
    const auto add = [&text](const char* words) {
        text += text.empty() ? "" : "; ";
        text += words;
    };
    if (row.integral && row.integral->is_converged == 0) {
        add("the error is larger than the tolerance");
    }
    if (row.integral && row.integral->n_unresolved > 0) {
        add("the surface stays undecided in small places");
    }
    if (row.extrema && (std::isinf(row.extrema->lower_bound) || std::isinf(row.extrema->upper_bound))) {
        add("it grows without limit, as far as its samples tell");
    }
    if (row.extrema && row.extrema->certainty != ELVIS_CERTIFIED) {
        add("extrema are sampled");
    }
    if (row.question.is_clipped) {
        add("of all of it, with what is cut away in the picture");
    }
    return text;
}

std::string place_text(const double position[3]) {
    if (!std::isfinite(position[0])) {
        return {};
    }
    return std::string("(")
        .append(digits(position[0], 6))
        .append(", ")
        .append(digits(position[1], 6))
        .append(", ")
        .append(digits(position[2], 6))
        .append(")");
}

std::string table_text(const std::vector<Numbers>& rows) {
    std::string text =
        "of\tfield\ttime_step\tintegral\terror\tmeasure\tmeasure_error\tmean\tminimum\tminimum_x\tminimum_y\tminimum_z\t"
        "maximum\tmaximum_x\tmaximum_y\tmaximum_z\tremark\n";
    for (const Numbers& row : rows) {
        std::string line;
        append_cell(line, row.question.of);
        append_cell(line, row.question.field);
        append_cell(line, std::to_string(row.question.time_step));
        if (row.integral) {
            const elvis_integral& found = *row.integral;
            for (const double number :
                 {found.value, found.error, found.measure, found.measure_error, found.value / found.measure}) {
                append_cell(line, std::isfinite(number) ? digits(number, 17) : std::string());
            }
        } else {
            line += "\t\t\t\t\t";
        }
        if (row.extrema) {
            append_extremum(line, row.extrema->minimum, row.extrema->minimum_position);
            append_extremum(line, row.extrema->maximum, row.extrema->maximum_position);
        } else {
            line += "\t\t\t\t\t\t\t\t";
        }
        append_cell(line, remark_of(row));
        text.append(line, 1); // Without the first tab.
        text += '\n';
    }
    return text;
}

} // namespace elvis::view
