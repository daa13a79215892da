#include "data_file.hpp"
#include <apps/elvis/view/scene/items.hpp>

#include <apps/elvis/answers/files/line_files.hpp>
#include <apps/elvis/answers/files/mesh_files.hpp>
#include <apps/elvis/answers/files/sample_files.hpp>

#include <core/base/counted.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace elvis::view {

namespace {

Writable lines_of(const Scene& scene, std::size_t index, const std::string& scenes_field) {
    Writable lines;
    lines.kind = Writable::Kind::lines;
    lines.surface = static_cast<std::uint32_t>(index);
    lines.what.of = item_label(scene, {ItemKind::surface, index});
    lines.what.field = scene["surfaces"][index].value("field", scenes_field);
    lines.what.time_step = time_step_of(scene);
    lines.what.is_clipped = scene["surfaces"][index].contains("clip") || scene.contains("threshold");
    return lines;
}

/** Of a volume of two dimensions. */
NumbersQuestion elements_of(const Scene& scene, const std::string& scenes_field) {
    NumbersQuestion elements;
    elements.of = "Elements";
    elements.domain = ELVIS_DOMAIN_BOUNDARY;
    elements.field = scenes_field;
    elements.time_step = time_step_of(scene);
    elements.is_clipped = scene.contains("threshold");
    return elements;
}

/** Those of one name are numbered. */
void tell_apart(std::vector<Writable>& all) {
    std::map<std::string, int> n_of_name;
    for (Writable& writable : all) {
        if (const int number = ++n_of_name[writable.what.of]; number > 1) {
            writable.what.of += " (" + std::to_string(number) + ")";
        }
    }
}

/** As the library knows it. */
std::string expression_of(const scene& shown, const std::string& field) {
    return field.empty() ? field : shown.expression(field);
}

/** Those whose values go along. */
std::vector<std::string> fields_of(const data& volume, const scene& shown, const DataFile& file) {
    std::vector<std::string> fields;
    if (file.values == WrittenValues::shown && !file.what.what.field.empty()) {
        fields.push_back(expression_of(shown, file.what.what.field));
    }
    for (std::uint32_t i = 0; file.values == WrittenValues::all && i < volume.info().n_fields; ++i) {
        fields.emplace_back(volume.field(i).name);
    }
    return fields;
}

/** A surface that is a number: of a vector its magnitude. */
std::string number_of(const data& volume, const std::string& expression) {
    const elvis_string name = expression.c_str();
    return volume.count_values(&name, 1) == 1 ? expression : std::string("norm(").append(expression).append(")");
}

WrittenReport write_mesh(const context& library, const data& volume, const scene& shown, const DataFile& file,
                         const task& watch) {
    const NumbersQuestion& what = file.what.what;
    const std::vector<std::string> fields = fields_of(volume, shown, file);
    const std::vector<elvis_string> groups = detail::c_strings(what.groups), names = detail::c_strings(fields);
    std::string level_field, contour_field;
    auto wanted = detail::sized<elvis_extraction>();
    wanted.domain = what.domain;
    wanted.groups = groups.data();
    wanted.n_groups = static_cast<std::uint32_t>(groups.size());
    wanted.time_step = what.time_step;
    std::ranges::copy(what.plane, wanted.plane);
    if (what.domain == ELVIS_DOMAIN_ISOSURFACE) {
        level_field = number_of(volume, expression_of(shown, what.level_field));
        wanted.level_field = level_field.c_str();
        wanted.isovalue = what.isovalue;
    }
    if (!file.contours.empty()) {
        contour_field = number_of(volume, expression_of(shown, what.field));
        wanted.contour_field = contour_field.c_str();
        wanted.contours = file.contours.data();
        wanted.n_contours = static_cast<std::uint32_t>(file.contours.size());
    }
    wanted.fields = names.data();
    wanted.n_fields = static_cast<std::uint32_t>(names.size());
    wanted.tolerance = file.tolerance;
    const extracted mesh = extract(library, volume, wanted, watch);
    commands::write_mesh(mesh, commands::mesh_columns(volume, fields), file.path);
    return {commands::report_of(mesh.info), commands::doubts_of(mesh.info)};
}

WrittenReport write_lines(const data& volume, const scene& shown, const DataFile& file, const task& watch) {
    const std::vector<std::string> fields = fields_of(volume, shown, file);
    const traced lines = volume.trace(shown, file.what.surface, fields, watch);
    commands::write_lines(lines, commands::line_columns(volume, fields), file.path);
    return {commands::report_of(lines), {}};
}

WrittenReport write_table(const data& volume, const scene& shown, const DataFile& file, const task& watch) {
    commands::SampleWishes wishes;
    wishes.fields = fields_of(volume, shown, file);
    wishes.time_step = file.what.what.time_step;
    commands::SamplePoints points;
    if (file.what.kind == Writable::Kind::line_probe) {
        points = commands::points_along({file.what.line.from, file.what.line.to}, n_line_points);
    } else {
        std::array<double, 6> box{};
        std::ranges::copy(volume.info().bounds, box.begin());
        points = commands::grid_in(box, file.n_points);
    }
    const commands::SampleTable table = commands::sample(volume, std::move(points), wishes, watch);
    commands::write_samples(table, file.path);
    WrittenReport report;
    report.facts.push_back(counted(table.points.size(), "point") + ", " + std::to_string(table.n_outside()) +
                           " of them in no element");
    if (!table.no_breaks_because.empty()) {
        report.doubts.push_back("where elements begin and end is not told: " + table.no_breaks_because);
    }
    return report;
}

WrittenReport write(const context& library, const data& volume, const scene& shown, const DataFile& file, const task& watch) {
    switch (file.what.kind) {
    case Writable::Kind::mesh:
        return write_mesh(library, volume, shown, file, watch);
    case Writable::Kind::lines:
        return write_lines(volume, shown, file, watch);
    case Writable::Kind::line_probe:
    case Writable::Kind::grid:
        break;
    }
    return write_table(volume, shown, file, watch);
}

} // namespace

std::vector<Writable> writables_of(const Scene& scene, const VolumeFacts& volume, const std::optional<LineProbe>& line) {
    const std::string scenes_field =
        said<std::string>(scene, "field").value_or(volume.fields.empty() ? "" : volume.fields[0].name);
    std::vector<Writable> all;
    for (const NumbersQuestion& question : questions_of(scene, volume)) {
        if (question.domain != ELVIS_DOMAIN_VOLUME) {
            all.push_back({Writable::Kind::mesh, question});
        }
    }
    if (volume.dimension == 2) {
        all.push_back({Writable::Kind::mesh, elements_of(scene, scenes_field)});
    }
    const Json& surfaces = part_of(scene, "surfaces");
    for (std::size_t index = 0; index < surfaces.size(); ++index) {
        const std::string type = surfaces[index]["type"];
        if ((type == "streamlines" || type == "pathlines") && is_shown(scene, {ItemKind::surface, index})) {
            all.push_back(lines_of(scene, index, scenes_field));
        }
    }
    Writable other;
    other.what.field = scenes_field;
    other.what.time_step = time_step_of(scene);
    other.what.is_clipped = scene.contains("threshold");
    if (line) {
        other.kind = Writable::Kind::line_probe;
        other.line = *line;
        other.what.of = "Line";
        other.what.field = line->field.value_or(scenes_field);
        all.push_back(other);
    }
    other.kind = Writable::Kind::grid;
    other.line = {};
    other.what.of = "Grid of points";
    other.what.field = scenes_field;
    all.push_back(other);
    tell_apart(all);
    return all;
}

const std::vector<const char*>& endings_of(Writable::Kind kind) {
    static const std::vector<const char*> of_meshes = {".vtp", ".ply", ".stl", ".glb"}, of_lines = {".vtp", ".csv"},
                                          of_line_probes = {".csv", ".npz", ".h5", ".svg"},
                                          of_grids = {".vti", ".npz", ".h5", ".csv"};
    switch (kind) {
    case Writable::Kind::mesh:
        return of_meshes;
    case Writable::Kind::lines:
        return of_lines;
    case Writable::Kind::line_probe:
        return of_line_probes;
    case Writable::Kind::grid:
        break;
    }
    return of_grids;
}

std::string problem_of(const DataFile& file) {
    const std::vector<const char*>& endings = endings_of(file.what.kind);
    if (std::ranges::none_of(endings, [&](const char* ending) { return file.path.ends_with(ending); })) {
        std::string text = "the name ends in none of";
        for (const char* ending : endings) {
            text.append(" ").append(ending);
        }
        return text;
    }
    if (file.path.ends_with(".stl") && !file.contours.empty()) {
        return ".stl holds triangles alone; .vtp, .ply and .glb hold lines, too";
    }
    if (file.path.ends_with(".stl") && file.values != WrittenValues::none) {
        return ".stl holds no values; .vtp, .ply and .glb do";
    }
    return {};
}

std::array<std::size_t, 3> usual_grid(const VolumeFacts& volume) {
    constexpr double n_longest = 64;
    const std::array<double, 6>& bounds = volume.bounds;
    const double longest = std::max({bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2]});
    std::array<std::size_t, 3> n{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double side = bounds[axis + 3] - bounds[axis];
        n[axis] = side > 0 ? std::max<std::size_t>(2, std::lround(n_longest * side / longest)) : 1;
    }
    return n;
}

WrittenReport write_data_file(const context& library, const data& volume, const scene& shown, const DataFile& file,
                              const task& watch) {
    WrittenReport report = write(library, volume, shown, file, watch);
    if (file.what.what.is_clipped) {
        report.facts.emplace_back("of all of it, with what is cut away in the picture");
    }
    return report;
}

} // namespace elvis::view
