#include "commands.hpp"
#include "frame_remarks.hpp"
#include "volume_argument.hpp"

#include <core/annotation/font.hpp>
#include <core/base/error.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/buffers_file.hpp>
#include <core/scene/frame_request.hpp>
#include <core/scene/output_file.hpp>
#include <core/scene/png_file.hpp>
#include <core/scene/scene.hpp>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace elvis::commands {

namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct Arguments {
    std::string input;
    std::string output;
    std::string field;
    std::vector<std::string> cut_planes;
    std::vector<std::string> boundary_groups;
    bool boundary = false;
    std::vector<double> isovalues;
    std::string volume;
    std::string integrator;
    double volume_step = 0;
    double volume_tolerance = 0;
    std::string contours;
    bool mesh_lines = false;
    std::string color_map;
    std::string range;
    std::string eye, look_at, up;
    double field_of_view = 0;
    double orthographic = 0;
    std::string background;
    std::string annotation;
    std::string lighting;
    std::string size;
    std::string precision;
    std::string device;
    std::string buffers;
    std::string stats;
    int time_step = -1;
    int repeat = 0;
    int bits = 8;
    bool validation = false;
    bool schema = false;
};

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
void apply_surfaces(const Arguments& arguments, Scene& scene) {
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
    if (!arguments.contours.empty()) {
        scene.contours = SceneContours{};
        scene.contours->values = numbers("--contours", arguments.contours, 1, 1000);
        std::sort(scene.contours->values.begin(), scene.contours->values.end());
        scene.contours->style.color = Rgb{0, 0, 0};
    }
    if (arguments.mesh_lines) {
        scene.mesh_lines = SceneLineStyle{};
    }
}

/** A volume rendering of the command line stands instead of that of the file; how it is integrated, beside. */
void apply_volume(const Arguments& arguments, Scene& scene) {
    if (arguments.volume == "none") {
        scene.volume_rendering.reset();
    } else if (!arguments.volume.empty()) {
        scene.volume_rendering = SceneVolumeRendering{};
        scene.volume_rendering->transfer_file = arguments.volume == "default" ? "" : arguments.volume;
    }
    for (const auto& [option, is_given] : {std::pair{"--integrator", !arguments.integrator.empty()},
                                           std::pair{"--volume-step", arguments.volume_step > 0},
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

/** What the command line says goes before what the file says. */
void apply_options(const Arguments& arguments, Scene& scene) {
    if (!arguments.field.empty()) {
        scene.field = arguments.field;
    }
    apply_surfaces(arguments, scene);
    apply_volume(arguments, scene);
    if (!arguments.color_map.empty()) {
        const bool is_file = std::filesystem::exists(arguments.color_map);
        scene.color_map.name = is_file ? "" : arguments.color_map;
        scene.color_map.file = is_file ? arguments.color_map : "";
        scene.color_map.points.clear();
    }
    if (!arguments.range.empty()) {
        const std::vector<double> list = numbers("--range", arguments.range, 2, 2);
        if (!(list[0] < list[1])) {
            throw UsageError("--range", "'" + arguments.range + "' must go from a smaller to a larger value");
        }
        scene.color_map.range = {list[0], list[1]};
    }
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
    if (!arguments.precision.empty()) {
        scene.precision = arguments.precision;
    }
    if (arguments.time_step >= 0) {
        scene.time_step = static_cast<std::uint32_t>(arguments.time_step);
    }
}

nlohmann::ordered_json stats_json(const Device& device, bool is_double, const Frame& frame, const Renderer& renderer,
                                  double load, double total, const std::vector<double>& repeated) {
    nlohmann::ordered_json root;
    root["device"] = device.summary().name;
    root["driver"] = device.summary().driver;
    root["precision"] = is_double ? "float64" : "float32";
    const RendererTimes& times = renderer.times();
    root["milliseconds"] = {{"load", load},
                            {"upload", times.upload_milliseconds},
                            {"hierarchy", times.hierarchy_milliseconds},
                            {"compile", times.compile_milliseconds},
                            {"render", frame.render_milliseconds},
                            {"device", frame.device_milliseconds},
                            {"total", total}};
    const FrameCounts& counts = frame.counts;
    root["counts"] = {{"pixels", counts.pixels},
                      {"hit_pixels", counts.hit_pixels},
                      {"field_evaluations", counts.field_evaluations},
                      {"newton_iterations", counts.newton_iterations},
                      {"newton_failures", counts.newton_failures},
                      {"undecided_pixels", counts.undecided_pixels},
                      {"nan_pixels", counts.nan_pixels},
                      {"work_limit_pixels", counts.work_limit_pixels},
                      {"estimated_pixels", counts.estimated_pixels},
                      {"contour_pixels", counts.contour_pixels},
                      {"undecided_contour_pixels", counts.undecided_contour_pixels},
                      {"mesh_line_pixels", counts.mesh_line_pixels},
                      {"undecided_mesh_line_pixels", counts.undecided_mesh_line_pixels},
                      {"refined_pixels", counts.refined_pixels},
                      {"isosurface_pixels", counts.isosurface_pixels},
                      {"undecided_isosurface_pixels", counts.undecided_isosurface_pixels},
                      {"isosurface_crossings", counts.isosurface_crossings},
                      {"projected_pixels", counts.projected_pixels},
                      {"certified_segments", counts.certified_segments},
                      {"segments", counts.segments},
                      {"verified_segments", counts.verified_segments},
                      {"undecided_segments", counts.undecided_segments},
                      {"excluded_pieces", counts.excluded_pieces},
                      {"undecided_pieces", counts.undecided_pieces},
                      {"volume_pixels", counts.volume_pixels},
                      {"inexact_volume_pixels", counts.inexact_volume_pixels},
                      {"volume_segments", counts.volume_segments},
                      {"empty_segments", counts.empty_segments},
                      {"volume_steps", counts.volume_steps},
                      {"volume_breakpoints", counts.volume_breakpoints}};
    const RendererMemory memory = renderer.memory();
    root["bytes"] = {{"field", memory.field_bytes}, {"geometry", memory.geometry_bytes}, {"hierarchy", memory.hierarchy_bytes}};
    if (!repeated.empty()) {
        root["frame_milliseconds"] = repeated;
    }
    return root;
}

void warn_about(const FrameCounts& counts) {
    for (const FrameRemark& remark : remarks_on(counts)) {
        spdlog::log(remark.is_warning ? spdlog::level::warn : spdlog::level::info, "{}", remark.text);
    }
}

void run(const Arguments& arguments) {
    if (arguments.schema) {
        std::printf("%s", std::string(scene_schema_text()).c_str());
        return;
    }
    if (arguments.input.empty() || arguments.output.empty()) {
        throw UsageError("render", "needs a scene or volume, and -o OUT.png; see elvis render --help");
    }
    const Clock::time_point start = Clock::now();
    Scene scene;
    if (is_scene(arguments.input)) {
        scene = read_scene(arguments.input);
    } else {
        scene.volume = arguments.input;
    }
    apply_options(arguments, scene);
    if (scene.volume.empty()) {
        throw Error(arguments.input, "'volume' is missing");
    }
    if (scene.annotation) {
        // Before the work is done: is there a font?
        const Font font(scene.annotation->style.font);
    }
    const bool is_double = scene.precision.value_or("float32") == "float64";

    const PluginRegistry registry;
    const RuntimeVolume volume = open_volume(registry, scene.volume, scene.plugin, scene.plugin_options);
    const double load = milliseconds_since(start);

    const Device device(arguments.device, arguments.validation);
    spdlog::info("device: {}", device.summary().name);
    Renderer renderer(device, volume, is_double ? Precision::float64 : Precision::float32);
    FrameRequest request = make_frame_request(scene, volume, renderer);
    if (request.volume && scene.volume_rendering->has_default_density()) {
        const auto& density = request.volume->transfer.density;
        spdlog::info("volume: density rises from {:.6g} at {:.6g} to {:.6g} at {:.6g}", density.front().density,
                     density.front().value, density.back().density, density.back().value);
    }
    request.with_buffers = !arguments.buffers.empty();
    Frame frame = renderer.render(request);
    std::vector<double> repeated;
    for (int repetition = 0; repetition < arguments.repeat; ++repetition) {
        const Clock::time_point frame_start = Clock::now();
        renderer.render(request);
        repeated.push_back(milliseconds_since(frame_start));
    }
    if (scene.annotation) {
        const AnnotationRequest annotation = make_annotation_request(*scene.annotation, request, frame, volume);
        for (const std::string& name : annotate(frame, annotation)) {
            spdlog::warn("annotation: there is no room for the {}", name);
        }
    }
    write_png(frame, arguments.output, arguments.bits);
    if (!arguments.buffers.empty()) {
        write_buffers(frame, arguments.buffers, is_double);
    }
    if (!arguments.stats.empty()) {
        const auto stats = stats_json(device, is_double, frame, renderer, load, milliseconds_since(start), repeated);
        write_text_file(arguments.stats, stats.dump(2) + "\n");
    }
    warn_about(frame.counts);
    if (arguments.validation && !device.validation_messages().empty()) {
        throw Error("validation layer", device.validation_messages().front());
    }
}

} // namespace

void add_render(CLI::App& app) {
    CLI::App* command = app.add_subcommand("render", "Draw one picture of a volume, from a scene file or options");
    auto a = std::make_shared<Arguments>();
    command->add_option("input", a->input, "Scene file (JSON) or volume");
    command->add_option("-o,--output", a->output, "Picture to write (PNG)");
    command->add_option("--field", a->field, "Field, component or expression: p, u[0], \"norm(curl(u))\"; a vector alone means its magnitude");
    command->add_option("--cut-plane", a->cut_planes, "a,b,c,d of the plane ax+by+cz+d=0; may be repeated")
        ->allow_extra_args(false);
    const CLI::Option* boundary =
        command->add_option("--boundary", a->boundary_groups, "The boundary, or one of its groups by name; may be repeated")
            ->expected(0, 1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command->add_option("--isosurface", a->isovalues, "Value of the field where a surface is drawn; may be repeated")
        ->allow_extra_args(false);
    command->add_option("--volume", a->volume,
                        "File of a transfer function (JSON, own or ParaView's) for the volume itself; default: the colour map, "
                        "with density from its lower to its upper end; none");
    std::vector<std::string> integrators;
    for (const auto& [name, integrator] : integrator_names()) {
        integrators.push_back(name);
    }
    command->add_option("--integrator", a->integrator, "Along rays through the volume; exact by default")
        ->check(CLI::IsMember(integrators));
    command->add_option("--volume-step", a->volume_step, "World length of steps, of riemann, trapezoid and categories")
        ->check(CLI::PositiveNumber);
    command
        ->add_option("--volume-tolerance", a->volume_tolerance,
                     "Of a color channel, of exact and adaptive-trapezoid; by default 0.001")
        ->check(CLI::PositiveNumber);
    command->add_option("--contours", a->contours, "V,V,..: values of contour lines");
    command->add_flag("--mesh-lines", a->mesh_lines, "Draw where boundaries of elements meet the surfaces");
    command->add_option("--color-map", a->color_map, "Built-in name, or file (ParaView JSON, ElVis XML)");
    command->add_option("--range", a->range, "LOW,HIGH: values at the ends of the colour map");
    command->add_option("--eye", a->eye, "x,y,z of the camera");
    command->add_option("--look-at", a->look_at, "x,y,z in the middle of the picture");
    command->add_option("--up", a->up, "x,y,z of the direction that is up in the picture");
    command->add_option("--fov", a->field_of_view, "Full vertical angle in degrees")->check(CLI::Range(1e-9, 179.999999));
    command->add_option("--orthographic", a->orthographic, "Height of an orthographic picture")->check(CLI::PositiveNumber);
    command->add_option("--background", a->background, "R,G,B or R,G,B,A from 0 to 1");
    command->add_option("--lighting", a->lighting, "none, or default: a headlight on all surfaces")
        ->check(CLI::IsMember({"none", "default"}));
    command->add_option("--annotation", a->annotation, "none, or default: color bars, axes and a title")
        ->check(CLI::IsMember({"none", "default"}));
    command->add_option("--size", a->size, "WIDTHxHEIGHT");
    command->add_option("--precision", a->precision, "float32 or float64")->check(CLI::IsMember({"float32", "float64"}));
    command->add_option("--device", a->device, "Name (or part of it) or index of the Vulkan device");
    command->add_option("--time-step", a->time_step, "Which time step")->check(CLI::NonNegativeNumber);
    command->add_option("--buffers", a->buffers, "HDF5 file with what the picture is made of, per pixel");
    command->add_option("--stats", a->stats, "JSON file with times and counts");
    command->add_option("--repeat", a->repeat, "Draw the frame that many times more, and put the times into --stats")
        ->check(CLI::NonNegativeNumber);
    command->add_option("--bits", a->bits, "Bits a channel: 8 or 16")->check(CLI::IsMember({8, 16}));
    command->add_flag("--validation", a->validation, "Run with the Vulkan validation layer; any message is an error");
    command->add_flag("--schema", a->schema, "Print the JSON Schema of scene files");
    command->callback([a, boundary] {
        a->boundary = boundary->count() > 0;
        // Without a name the list holds an empty one.
        std::erase_if(a->boundary_groups, [](const std::string& name) { return name.empty() || name == "{}"; });
        run(*a);
    });
}

} // namespace elvis::commands
