#include "render_options.hpp"

#include <core/base/error.hpp>
#include <core/scene/line_width.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

namespace elvis::commands {

namespace {

/** "1,0,0,-0.5" as that many finite numbers. */
std::vector<double> numbers(const char* option, const std::string& text, std::size_t least, std::size_t most) {
    std::vector<double> list;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        std::size_t used = 0;
        double value = std::nan("");
        try {
            value = std::stod(part, &used);
        } catch (const std::exception&) {
            used = 0;
        }
        if (used == 0 || used != part.size() || !std::isfinite(value)) {
            throw UsageError(option, "'" + text + "' is no list of numbers separated by commas");
        }
        list.push_back(value);
        begin = end + 1;
    }
    if (list.size() < least || list.size() > most) {
        throw UsageError(option, "'" + text + "' has " + std::to_string(list.size()) + " numbers where " +
                                     std::to_string(least) + (most > least ? " or " + std::to_string(most) : "") +
                                     " are expected");
    }
    return list;
}

Vector3 vector3(const char* option, const std::string& text) {
    const std::vector<double> list = numbers(option, text, 3, 3);
    return {list[0], list[1], list[2]};
}

/** Surfaces of the command line stand instead of those of the file. */
void apply_surfaces(const RenderArguments& arguments, Scene& scene) {
    if (!arguments.cut_planes.empty() || arguments.boundary || !arguments.isovalues.empty()) {
        scene.surfaces.clear();
    }
    for (const std::string& text : arguments.cut_planes) {
        const std::vector<double> list = numbers("--cut-plane", text, 4, 4);
        if (list[0] == 0 && list[1] == 0 && list[2] == 0) {
            throw UsageError("--cut-plane", "'" + text + "' has a normal of length zero");
        }
        scene.surfaces.push_back({CutPlane{{list[0], list[1], list[2], list[3]}}});
    }
    if (arguments.boundary) {
        scene.surfaces.push_back({BoundaryFaces{arguments.boundary_groups}});
    }
    if (!arguments.isovalues.empty()) {
        Isosurfaces isosurfaces;
        isosurfaces.values = arguments.isovalues;
        std::sort(isosurfaces.values.begin(), isosurfaces.values.end());
        scene.surfaces.push_back({std::move(isosurfaces)});
    }
    if (arguments.has_contours) {
        scene.contours = SceneContours{};
        scene.contours->style.width = width_by_size;
        scene.contours->is_round = arguments.contours.empty();
        if (!arguments.contours.empty()) {
            scene.contours->values = numbers("--contours", arguments.contours, 1, 1000);
            std::sort(scene.contours->values.begin(), scene.contours->values.end());
        }
    }
    if (arguments.mesh_lines) {
        scene.mesh_lines = SceneLineStyle{};
    }
}

/** A volume rendering of the command line stands instead of that of the file; how it is integrated, beside. */
void apply_volume(const RenderArguments& arguments, Scene& scene) {
    if (arguments.volume == "none") {
        scene.volume_rendering.reset();
    } else if (!arguments.volume.empty()) {
        scene.volume_rendering = SceneVolumeRendering{};
        scene.volume_rendering->transfer_file = arguments.volume == "default" ? "" : arguments.volume;
    }
    for (const auto& [option, is_given] :
         {std::pair{"--integrator", !arguments.integrator.empty()}, std::pair{"--volume-step", arguments.volume_step > 0},
          std::pair{"--volume-tolerance", arguments.volume_tolerance > 0}}) {
        if (is_given && !scene.volume_rendering) {
            throw UsageError(option, "means nothing without --volume, or a scene with volume_rendering");
        }
    }
    if (!arguments.integrator.empty()) {
        scene.volume_rendering->integrator = integrator_named(arguments.integrator).value();
    }
    if (arguments.volume_step > 0) {
        if (!has_steps(scene.volume_rendering->integrator)) {
            throw UsageError("--volume-step", "is of the integrators riemann, trapezoid and categories only");
        }
        scene.volume_rendering->step = arguments.volume_step;
    }
    if (arguments.volume_tolerance > 0) {
        if (has_steps(scene.volume_rendering->integrator)) {
            throw UsageError("--volume-tolerance", "is of the integrators exact and adaptive-trapezoid only");
        }
        scene.volume_rendering->tolerance = arguments.volume_tolerance;
    }
}

/** Pictures over time or around the volume; a path of the file stays beside the command line's steps, and the other way round.
 */
void apply_animation(const RenderArguments& arguments, Scene& scene) {
    if (arguments.time_steps.empty() && arguments.turntable == 0 && !scene.animation) {
        for (const auto& [option, is_given] :
             {std::pair{"--film", !arguments.film.empty()}, std::pair{"--frames-a-second", arguments.frames_a_second > 0},
              std::pair{"--turntable-axis", !arguments.turntable_axis.empty()}, std::pair{"--resume", arguments.resume}}) {
            if (is_given) {
                throw UsageError(option, "means nothing without --time-steps, --turntable, or a scene with animation");
            }
        }
        return;
    }
    SceneAnimation animation = scene.animation.value_or(SceneAnimation{});
    if (!arguments.time_steps.empty()) {
        animation.time_steps = parse_time_steps(arguments.time_steps);
        if (!animation.time_steps) {
            throw UsageError("--time-steps", "'" + arguments.time_steps + "' is neither all, FIRST:LAST nor FIRST:LAST:STRIDE");
        }
    }
    if (arguments.turntable > 0) {
        animation.turntable = Turntable{static_cast<std::uint32_t>(arguments.turntable), std::nullopt, 360};
        animation.key_frames.clear();
    }
    if (!arguments.turntable_axis.empty()) {
        if (!animation.turntable) {
            throw UsageError("--turntable-axis", "means nothing without --turntable");
        }
        animation.turntable->axis = vector3("--turntable-axis", arguments.turntable_axis);
        if (*animation.turntable->axis == Vector3{}) {
            throw UsageError("--turntable-axis", "'" + arguments.turntable_axis + "' has length zero");
        }
    }
    if (arguments.frames_a_second > 0) {
        animation.frames_a_second = arguments.frames_a_second;
    }
    scene.animation = std::move(animation);
}

} // namespace

Sharing sharing_of(const RenderArguments& arguments) {
    if (arguments.share.empty()) {
        return {};
    }
    if (arguments.share == "all") {
        return Sharing::all();
    }
    if (arguments.share == "none") {
        return Sharing::none();
    }
    // Versions before 0.2 called the rows parts.
    const std::string wanted = arguments.share == "parts" ? "rows" : arguments.share;
    std::string names;
    for (const auto& [name, sharing] : Sharing::each()) {
        if (name == wanted) {
            return sharing;
        }
        names += ", " + name;
    }
    throw UsageError("--share", "'" + arguments.share + "' is none of all, none" + names);
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

void apply_color_map(const RenderArguments& arguments, Scene& scene) {
    if (!arguments.color_map.empty()) {
        const bool is_file = std::filesystem::exists(arguments.color_map);
        scene.color_map.name = is_file ? "" : arguments.color_map;
        scene.color_map.file = is_file ? arguments.color_map : "";
        scene.color_map.points.clear();
    }
    if (percentiles_of(arguments)) {
        scene.color_map.range.reset(); // Until there is a volume to take them of.
    } else if (!arguments.range.empty()) {
        const std::vector<double> list = numbers("--range", arguments.range, 2, 2);
        if (!(list[0] < list[1])) {
            throw UsageError("--range", "'" + arguments.range + "' must go from a smaller to a larger value");
        }
        scene.color_map.range = {list[0], list[1]};
    }
    scene.color_map.is_logarithmic = scene.color_map.is_logarithmic || arguments.log_scale;
    if (scene.color_map.is_logarithmic && scene.color_map.range && !((*scene.color_map.range)[0] > 0)) {
        throw UsageError(arguments.range.empty() ? "--log-scale" : "--range",
                         "the range must be above 0 on a logarithmic scale");
    }
}

void apply_camera(const RenderArguments& arguments, Scene& scene) {
    if (!arguments.eye.empty()) {
        scene.camera.eye = vector3("--eye", arguments.eye);
    }
    if (!arguments.look_at.empty()) {
        scene.camera.look_at = vector3("--look-at", arguments.look_at);
    }
    if (!arguments.up.empty()) {
        scene.camera.up = vector3("--up", arguments.up);
    }
    if (arguments.field_of_view > 0) {
        scene.camera.field_of_view = arguments.field_of_view;
    }
    if (arguments.orthographic > 0) {
        scene.camera.orthographic = true;
        scene.camera.height = arguments.orthographic;
    }
}

void apply_image(const RenderArguments& arguments, Scene& scene) {
    if (!arguments.background.empty()) {
        const std::vector<double> list = numbers("--background", arguments.background, 3, 4);
        scene.background = {list[0], list[1], list[2], list.size() > 3 ? list[3] : 1.0};
        for (const double channel : scene.background) {
            if (channel < 0 || channel > 1) {
                throw UsageError("--background", "'" + arguments.background + "' has a number outside 0 to 1");
            }
        }
    }
    if (!arguments.annotation.empty()) {
        scene.annotation = arguments.annotation == "default" ? std::optional(SceneAnnotation{}) : std::nullopt;
    }
    if (!arguments.lighting.empty()) {
        scene.lighting = arguments.lighting == "default" ? std::optional(Lighting{}) : std::nullopt;
    } else if (!is_scene(arguments.input) && !arguments.isovalues.empty() && arguments.cut_planes.empty() &&
               !arguments.boundary) {
        // Without light they are flat shapes of one colour; colours of planes and boundaries are to be read. A scene says what
        // it wants.
        scene.lighting = Lighting{};
    }
    if (!arguments.size.empty()) {
        unsigned width = 0, height = 0;
        int used = 0;
        if (std::sscanf(arguments.size.c_str(), "%ux%u%n", &width, &height, &used) != 2 ||
            static_cast<std::size_t>(used) != arguments.size.size() || width == 0 || height == 0 || width > 32768 ||
            height > 32768) {
            throw UsageError("--size", "'" + arguments.size + "' is not WIDTHxHEIGHT with both from 1 to 32768");
        }
        scene.size = {width, height};
    }
}

} // namespace

void apply_options(const RenderArguments& arguments, Scene& scene) {
    if (!arguments.field.empty()) {
        scene.field = arguments.field;
    }
    apply_surfaces(arguments, scene);
    apply_volume(arguments, scene);
    apply_color_map(arguments, scene);
    apply_camera(arguments, scene);
    apply_image(arguments, scene);
    if (arguments.precision) {
        scene.precision = arguments.precision;
    }
    if (arguments.time_step >= 0) {
        scene.time_step = static_cast<std::uint32_t>(arguments.time_step);
    }
    apply_animation(arguments, scene);
}

} // namespace elvis::commands
