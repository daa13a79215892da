#include "render_options.hpp"

#include <apps/elvis/number_list.hpp>

#include <core/base/error.hpp>
#include <core/base/memory_budget.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <tuple>
#include <utility>

namespace elvis::commands {

namespace {

using nlohmann::json;

std::vector<double> vector3(const char* option, const std::string& text) { return numbers(option, text, 3, 3); }

/** What a scene says, and may be told. */
class Document {
public:
    explicit Document(scene& of) : m_scene(of) {}

    bool has(const char* pointer) const { return json::parse(m_scene.json()).contains(json::json_pointer(pointer)); }
    json at(const char* pointer) const { return json::parse(m_scene.json(pointer)); }
    void set(const std::string& pointer, const json& value) { m_scene.set(pointer, value.dump()); }
    void remove(const char* pointer) {
        if (has(pointer)) {
            m_scene.remove(pointer);
        }
    }

private:
    scene& m_scene;
};

/** Of the command line, seen from the working directory, whatever folder the scene is in. */
std::string whole_path(const std::string& path) { return std::filesystem::absolute(path).lexically_normal().string(); }

/** On the surfaces of the command line, which get names for it; in the volume if there are none. */
void apply_arrows(const RenderArguments& arguments, Document& scene) {
    if (arguments.arrows.empty()) {
        return;
    }
    json arrows = {{"type", "arrows"}, {"vectors", arguments.arrows}};
    if (arguments.arrow_spacing > 0) {
        arrows["spacing"] = arguments.arrow_spacing;
    }
    std::vector<std::string> names;
    const std::size_t n_surfaces = scene.has("/surfaces") ? scene.at("/surfaces").size() : 0;
    for (std::size_t i = 0; i < n_surfaces; ++i) {
        const std::string pointer = "/surfaces/" + std::to_string(i);
        const auto type = scene.at((pointer + "/type").c_str());
        if (type != "streamlines" && type != "pathlines") {
            names.push_back("surface " + std::to_string(i));
            scene.set(pointer + "/name", names.back());
        }
    }
    for (const std::string& name : names) {
        arrows["on"] = name;
        scene.set("/surfaces/-", arrows);
    }
    if (names.empty()) {
        scene.set("/surfaces/-", arrows);
    }
}

bool has_lines(const RenderArguments& arguments) {
    return !arguments.streamlines.empty() || !arguments.pathlines.empty() || !arguments.arrows.empty();
}

void apply_streamlines(const char* type, const std::string& flow, double ribbon_width, Document& scene) {
    if (flow.empty()) {
        return;
    }
    json lines = {{"type", type}, {"flow", flow}};
    if (ribbon_width > 0) {
        lines["ribbon_width"] = ribbon_width;
    }
    scene.set("/surfaces/-", lines);
}

/** Surfaces of the command line stand instead of those of the file. */
void apply_surfaces(const RenderArguments& arguments, Document& scene) {
    if (!arguments.cut_planes.empty() || arguments.boundary || !arguments.isovalues.empty() || has_lines(arguments)) {
        scene.remove("/surfaces");
        scene.remove("/isosurfaces");
    }
    for (const std::string& text : arguments.cut_planes) {
        const std::vector<double> plane = numbers("--cut-plane", text, 4, 4);
        if (plane[0] == 0 && plane[1] == 0 && plane[2] == 0) {
            throw UsageError("--cut-plane", "'" + text + "' has a normal of length zero");
        }
        scene.set("/surfaces/-", {{"type", "plane"}, {"plane", plane}});
    }
    if (arguments.boundary) {
        json boundary = {{"type", "boundary"}};
        if (!arguments.boundary_groups.empty()) {
            boundary["groups"] = arguments.boundary_groups;
        }
        scene.set("/surfaces/-", boundary);
    }
    if (!arguments.isovalues.empty()) {
        std::vector<double> values = arguments.isovalues;
        std::sort(values.begin(), values.end());
        scene.set("/surfaces/-", {{"type", "isosurface"}, {"values", values}});
    }
    apply_streamlines("streamlines", arguments.streamlines, arguments.ribbon_width, scene);
    apply_streamlines("pathlines", arguments.pathlines, arguments.ribbon_width, scene);
    apply_arrows(arguments, scene);
    if (arguments.undeformed_edges) {
        if (!scene.has("/warp")) {
            throw UsageError("--undeformed-edges", "means nothing without --warp, or a scene with warp");
        }
        scene.set("/surfaces/-", {{"type", "wireframe"}, {"undeformed", true}, {"color", {0.5, 0.5, 0.5}}});
    }
}

void apply_lines(const RenderArguments& arguments, Document& scene) {
    if (arguments.has_contours) {
        json contours = json::object();
        if (!arguments.contours.empty()) {
            std::vector<double> values = numbers("--contours", arguments.contours, 1, 1000);
            std::sort(values.begin(), values.end());
            contours["values"] = values;
        }
        scene.set("/contours", contours);
    }
    if (arguments.mesh_lines) {
        scene.set("/mesh_lines", json::object());
    }
    if (!arguments.lic.empty()) {
        scene.set("/lic", {{"field", arguments.lic}});
    }
}

/** A volume rendering of the command line stands instead of that of the file; how it is integrated, beside. */
void apply_volume(const RenderArguments& arguments, Document& scene) {
    if (arguments.volume == "none") {
        scene.remove("/volume_rendering");
    } else if (arguments.volume == "default") {
        scene.set("/volume_rendering", json::object());
    } else if (!arguments.volume.empty()) {
        scene.set("/volume_rendering", {{"transfer", whole_path(arguments.volume)}});
    }
    for (const auto& [option, is_given] :
         {std::pair{"--integrator", !arguments.integrator.empty()}, std::pair{"--volume-step", arguments.volume_step > 0},
          std::pair{"--volume-tolerance", arguments.volume_tolerance > 0}}) {
        if (is_given && !scene.has("/volume_rendering")) {
            throw UsageError(option, "means nothing without --volume, or a scene with volume_rendering");
        }
    }
    if (!arguments.integrator.empty()) {
        scene.set("/volume_rendering/integrator", arguments.integrator);
    }
    const bool has_tolerance = !scene.has("/volume_rendering/integrator") ||
                               scene.at("/volume_rendering/integrator") == "exact" ||
                               scene.at("/volume_rendering/integrator") == "adaptive-trapezoid";
    if (arguments.volume_step > 0) {
        if (has_tolerance) {
            throw UsageError("--volume-step", "is of the integrators riemann, trapezoid and categories only");
        }
        scene.set("/volume_rendering/step", arguments.volume_step);
    }
    if (arguments.volume_tolerance > 0) {
        if (!has_tolerance) {
            throw UsageError("--volume-tolerance", "is of the integrators exact and adaptive-trapezoid only");
        }
        scene.set("/volume_rendering/tolerance", arguments.volume_tolerance);
    }
}

/** Options of animations where there is none. */
void refuse_animation_options(const RenderArguments& arguments) {
    for (const auto& [option, is_given] :
         {std::pair{"--film", !arguments.film.empty()}, std::pair{"--frames-a-second", arguments.frames_a_second > 0},
          std::pair{"--turntable-axis", !arguments.turntable_axis.empty()}, std::pair{"--resume", arguments.resume}}) {
        if (is_given) {
            throw UsageError(option, "means nothing without --time-steps, --phases, --turntable, or a scene with animation");
        }
    }
}

/**
 * Pictures over time or around the volume; a path of the file stays beside the command line's steps, and the other way round.
 */
void apply_animation(const RenderArguments& arguments, Document& scene) {
    const bool has_animation = scene.has("/animation");
    if (arguments.time_steps.empty() && arguments.turntable == 0 && arguments.phases == 0 && !has_animation) {
        return refuse_animation_options(arguments);
    }
    json animation = has_animation ? scene.at("/animation") : json::object();
    if (!arguments.time_steps.empty()) {
        try {
            scene.set("/animation/time_steps", arguments.time_steps);
        } catch (const error&) {
            throw UsageError("--time-steps", "'" + arguments.time_steps + "' is neither all, FIRST:LAST nor FIRST:LAST:STRIDE");
        }
        animation["time_steps"] = arguments.time_steps;
    }
    if (arguments.phases > 0) {
        animation["phases"] = arguments.phases;
    }
    if (arguments.turntable > 0) {
        animation["turntable"] = {{"frames", arguments.turntable}};
        animation.erase("key_frames");
    }
    if (!arguments.turntable_axis.empty()) {
        if (!animation.contains("turntable")) {
            throw UsageError("--turntable-axis", "means nothing without --turntable");
        }
        const std::vector<double> axis = vector3("--turntable-axis", arguments.turntable_axis);
        if (axis == std::vector<double>(3, 0.0)) {
            throw UsageError("--turntable-axis", "'" + arguments.turntable_axis + "' has length zero");
        }
        animation["turntable"]["axis"] = axis;
    }
    if (arguments.frames_a_second > 0) {
        animation["frames_a_second"] = arguments.frames_a_second;
    }
    scene.set("/animation", animation);
}

} // namespace

elvis_render_flags sharing_of(const RenderArguments& arguments) {
    // Versions before 0.2 called the rows parts.
    const std::string& wanted = arguments.share == "parts" ? "rows" : arguments.share;
    if (wanted.empty() || wanted == "rows") {
        return 0;
    }
    if (wanted == "all") {
        return ELVIS_RENDER_SHARE_DEPTHS;
    }
    if (wanted == "none") {
        return ELVIS_RENDER_ALL_ROWS;
    }
    if (wanted == "depths") {
        return ELVIS_RENDER_SHARE_DEPTHS | ELVIS_RENDER_ALL_ROWS;
    }
    throw UsageError("--share", "'" + arguments.share + "' is none of all, none, depths, rows");
}

std::optional<std::array<double, 2>> percentiles_of(const RenderArguments& arguments) {
    std::string text = arguments.range;
    if (text.find('%') == std::string::npos) {
        return std::nullopt;
    }
    const std::size_t comma = text.find(',');
    if (!text.ends_with('%') || comma == std::string::npos || comma == 0 || text[comma - 1] != '%') {
        throw UsageError("--range", "'" + text + "' has a percentage beside a number");
    }
    std::erase(text, '%');
    const std::vector<double> list = numbers("--range", text, 2, 2);
    if (!(0 <= list[0] && list[0] < list[1] && list[1] <= 100)) {
        throw UsageError("--range", "'" + arguments.range + "' must go from a smaller to a larger percentage, from 0% to 100%");
    }
    return std::array<double, 2>{list[0] / 100, list[1] / 100};
}

namespace {

void apply_color_map(const RenderArguments& arguments, Document& scene) {
    if (!arguments.color_map.empty()) {
        for (const char* pointer : {"/color_map/name", "/color_map/file", "/color_map/points"}) {
            scene.remove(pointer);
        }
        if (std::filesystem::exists(arguments.color_map)) {
            scene.set("/color_map/file", whole_path(arguments.color_map));
        } else {
            scene.set("/color_map/name", arguments.color_map);
        }
    }
    if (percentiles_of(arguments)) {
        scene.remove("/color_map/range"); // Until there is a volume to take them of.
    } else if (!arguments.range.empty()) {
        const std::vector<double> range = numbers("--range", arguments.range, 2, 2);
        if (!(range[0] < range[1])) {
            throw UsageError("--range", "'" + arguments.range + "' must go from a smaller to a larger value");
        }
        if (arguments.log_scale && !(range[0] > 0)) {
            throw UsageError("--range", "the range must be above 0 on a logarithmic scale");
        }
        scene.set("/color_map/range", range);
    }
    if (arguments.log_scale) {
        if (scene.has("/color_map/range") && !(scene.at("/color_map/range/0") > 0)) {
            throw UsageError("--log-scale", "the range must be above 0 on a logarithmic scale");
        }
        scene.set("/color_map/scale", "logarithmic");
    }
}

void apply_camera(const RenderArguments& arguments, Document& scene) {
    if (!arguments.eye.empty()) {
        scene.set("/camera/eye", vector3("--eye", arguments.eye));
    }
    if (!arguments.look_at.empty()) {
        scene.set("/camera/look_at", vector3("--look-at", arguments.look_at));
    }
    if (!arguments.up.empty()) {
        scene.set("/camera/up", vector3("--up", arguments.up));
    }
    if (arguments.field_of_view > 0) {
        scene.set("/camera/field_of_view", arguments.field_of_view);
    }
    if (arguments.orthographic > 0) {
        scene.set("/camera/type", "orthographic");
        scene.set("/camera/height", arguments.orthographic);
    }
}

std::array<unsigned, 2> size_of(const std::string& text) {
    unsigned width = 0, height = 0;
    int used = 0;
    if (std::sscanf(text.c_str(), "%ux%u%n", &width, &height, &used) != 2 || static_cast<std::size_t>(used) != text.size() ||
        width == 0 || height == 0 || width > 32768 || height > 32768) {
        throw UsageError("--size", "'" + text + "' is not WIDTHxHEIGHT with both from 1 to 32768");
    }
    return {width, height};
}

/** A shift of the picture, which makes room for colour bars, is in pixels: it grows with the picture. */
void apply_size(const std::array<unsigned, 2>& size, Document& scene) {
    if (scene.has("/camera/image_shift") && scene.has("/image/size")) {
        auto shift = scene.at("/camera/image_shift").get<std::array<double, 2>>();
        const double height = scene.at("/image/size")[1];
        for (double& pixels : shift) {
            pixels *= size[1] / height;
        }
        scene.set("/camera/image_shift", shift);
    }
    scene.set("/image/size", size);
}

void apply_joins(const std::vector<std::string>& joins, Document& scene) {
    json list = json::array();
    for (const std::string& text : joins) {
        const JoinArgument join = parse_join(text);
        list.push_back({{"name", join.name}});
        if (!join.file.empty()) {
            list.back()["path"] = join.file;
        }
        if (join.time_step) {
            list.back()["time_step"] = *join.time_step;
        }
    }
    if (!list.empty()) {
        scene.set("/volume/joined", list);
    }
}

void apply_warp(const WarpArguments& warp, Document& scene) {
    if (warp.field.empty()) {
        return;
    }
    json said = {{"field", warp.field}, {"factor", warp.factor}, {"phase", warp.phase}};
    if (!warp.imaginary.empty()) {
        said["imaginary"] = warp.imaginary;
    }
    scene.set("/warp", said);
}

void apply_budget(const RenderArguments& arguments, Document& scene) {
    for (const auto& [option, key, size] : {std::tuple{"--device-memory", "/memory/device", &arguments.device_memory},
                                            std::tuple{"--host-memory", "/memory/host", &arguments.host_memory}}) {
        if (size->empty()) {
            continue;
        }
        if (!bytes_of_size(*size)) {
            throw UsageError(option, no_size_text(*size));
        }
        scene.set(key, *size);
    }
}

void apply_image(const RenderArguments& arguments, Document& scene) {
    if (arguments.samples > 0) {
        scene.set("/image/samples", arguments.samples);
    }
    if (!arguments.background.empty()) {
        const std::vector<double> color = numbers("--background", arguments.background, 3, 4);
        if (!std::ranges::all_of(color, [](double channel) { return 0 <= channel && channel <= 1; })) {
            throw UsageError("--background", "'" + arguments.background + "' has a number outside 0 to 1");
        }
        scene.set("/image/background", color);
    }
    if (!arguments.annotation.empty()) {
        scene.set("/image/annotation", arguments.annotation);
    }
    if (!arguments.lighting.empty()) {
        scene.set("/lighting", arguments.lighting);
    } else if (!arguments.is_scene && (!arguments.isovalues.empty() || has_lines(arguments)) && arguments.cut_planes.empty() &&
               !arguments.boundary) {
        // Without light they are flat shapes of one colour; colours of planes and boundaries are to be read. A scene says what
        // it wants.
        scene.set("/lighting", "default");
    }
    if (!arguments.size.empty()) {
        apply_size(size_of(arguments.size), scene);
    }
}

} // namespace

void apply_options(const RenderArguments& arguments, scene& shown) {
    Document document(shown);
    if (!arguments.field.empty()) {
        document.set("/field", arguments.field);
    }
    if (!arguments.threshold.empty()) {
        document.set("/threshold", arguments.threshold);
    }
    apply_joins(arguments.joins, document);
    apply_warp(arguments.warp, document);
    apply_surfaces(arguments, document);
    apply_lines(arguments, document);
    apply_volume(arguments, document);
    apply_color_map(arguments, document);
    apply_camera(arguments, document);
    apply_image(arguments, document);
    apply_budget(arguments, document);
    if (!arguments.precision.empty()) {
        document.set("/precision", arguments.precision);
    }
    if (arguments.time_step >= 0 && document.has("/volume")) {
        document.set("/volume/time_step", arguments.time_step);
    }
    apply_animation(arguments, document);
}

} // namespace elvis::commands
