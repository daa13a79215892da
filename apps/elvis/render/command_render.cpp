#include "render_options.hpp"
#include "render_scenes.hpp"
#include <apps/elvis/commands.hpp>

#include <core/base/error.hpp>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <memory>

namespace elvis::commands {

namespace {

void run(const RenderArguments& arguments) {
    if (arguments.schema) {
        std::printf("%s", elvis_scene_schema());
        return;
    }
    if (arguments.inputs.empty() || arguments.output.empty()) {
        throw UsageError("render", "needs a scene or volume, and -o OUT.png; see elvis render --help");
    }
    render_scenes(arguments);
}

/** What the schema of scenes allows there. */
std::vector<std::string> words_of(const char* pointer) {
    static const nlohmann::json schema = nlohmann::json::parse(elvis_scene_schema());
    return schema.at(nlohmann::json::json_pointer(pointer)).at("enum").get<std::vector<std::string>>();
}

/** The option's library takes nan and inf for numbers, and nan for one in any range. */
CLI::Validator finite_number() {
    return {[](std::string& text) {
                double number = 0;
                const bool is_finite = CLI::detail::lexical_cast(text, number) && std::isfinite(number);
                return is_finite ? std::string() : "'" + text + "' is no finite number";
            },
            ""};
}

void add_surfaces(CLI::App& command, RenderArguments& a) {
    command.add_option("input", a.inputs,
                       "Scene file (JSON), or volume, whatever its format (geometry first, then field files); of several "
                       "scenes a picture each");
    command.add_option(
        "-o,--output", a.output,
        "Picture to write (PNG; SVG or PDF with annotation as shapes and text), or folder for those of an animation or of "
        "several scenes");
    command.add_option("--field", a.field,
                       "Field, component or expression: p, u[0], \"norm(curl(u))\"; a vector alone means its magnitude");
    command.add_option(
        "--threshold", a.threshold,
        "Show only the part of the volume where this holds: comparisons of expressions, joined by &&: \"p > 0.2\"");
    command.add_option("--cut-plane", a.cut_planes, "a,b,c,d of the plane ax+by+cz+d=0; may be repeated")
        ->allow_extra_args(false);
    command
        .add_option("--boundary", a.boundary_groups, "The whole boundary; with a name, that group of it only; may be repeated")
        ->expected(0, 1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command.add_option("--isosurface", a.isovalues, "Value of the field where a surface is drawn; may be repeated")
        ->allow_extra_args(false)
        ->check(finite_number());
}

void add_volume(CLI::App& command, RenderArguments& a) {
    command.add_option("--volume", a.volume,
                       "File of a transfer function (JSON, own or ParaView's) for the volume itself; default: the colour map, "
                       "with density from its lower to its upper end; none");
    command.add_option("--integrator", a.integrator, "Along rays through the volume; exact by default")
        ->check(CLI::IsMember(words_of("/properties/volume_rendering/properties/integrator")));
    command.add_option("--volume-step", a.volume_step, "World length of steps, of riemann, trapezoid and categories")
        ->check(CLI::PositiveNumber)
        ->check(finite_number());
    command
        .add_option("--volume-tolerance", a.volume_tolerance,
                    "Of a color channel, of exact and adaptive-trapezoid; by default 0.001")
        ->check(CLI::PositiveNumber)
        ->check(finite_number());
}

void add_lines_and_colors(CLI::App& command, RenderArguments& a) {
    command.add_option("--contours", a.contours, "V,V,..: values of contour lines; round ones if none are given")
        ->expected(0, 1);
    command.add_flag("--mesh-lines", a.mesh_lines, "Draw where boundaries of elements meet the surfaces");
    command.add_option("--lic", a.lic, "Line integral convolution: streaks on the surfaces along this vector field")
        ->option_text("VECTOR");
    std::string maps;
    for (const std::string& name : words_of("/$defs/color_map/properties/name")) {
        maps += (maps.empty() ? "" : ", ") + name;
    }
    command.add_option("--color-map", a.color_map,
                       "Built-in name (" + maps +
                           "; gray is even in lightness, not linear in RGB), or file (ParaView JSON, ElVis XML)");
    command.add_option(
        "--range", a.range,
        "LOW,HIGH: values at the ends of the colour map; 2%,98%: those below which these parts of the volume lie");
    command.add_flag("--log-scale", a.log_scale,
                     "Colours by the logarithm of values, which have none of their own where they are not above 0");
}

void add_camera(CLI::App& command, RenderArguments& a) {
    command.add_option("--eye", a.eye, "x,y,z of the camera");
    command.add_option("--look-at", a.look_at, "x,y,z in the middle of the picture");
    command.add_option("--up", a.up, "x,y,z of the direction that is up in the picture");
    command.add_option("--fov", a.field_of_view, "Full vertical angle in degrees")
        ->check(CLI::Range(1e-9, 179.999999))
        ->check(finite_number());
    command.add_option("--orthographic", a.orthographic, "Height of an orthographic picture")
        ->check(CLI::PositiveNumber)
        ->check(finite_number());
}

void add_picture(CLI::App& command, RenderArguments& a) {
    command.add_option("--background", a.background, "R,G,B or R,G,B,A from 0 to 1");
    command
        .add_option(
            "--lighting", a.lighting,
            "none, or default: a headlight on all surfaces; isosurfaces alone of a volume have it unless told otherwise")
        ->check(CLI::IsMember({"none", "default"}));
    command.add_option("--annotation", a.annotation, "none, or default: color bars, axes and a title")
        ->check(CLI::IsMember({"none", "default"}));
    command.add_option("--size", a.size, "WIDTHxHEIGHT");
    command
        .add_option("--samples", a.samples,
                    "N: each pixel is the mean of N by N, so that lines and silhouettes are smooth; buffers are those without")
        ->check(CLI::Range(1, 8));
    command.add_option("--precision", a.precision, "float32 or float64")
        ->check(CLI::IsMember(words_of("/properties/precision")));
    CLI::Option* const device =
        command.add_option("--device", a.device, "Name (or part of it), index, PCI bus id or UUID of the Vulkan device");
    command
        .add_option("--devices", a.devices,
                    "all, or several such names with ',' between them: each device draws some rows of each picture")
        ->excludes(device);
}

void add_animation(CLI::App& command, RenderArguments& a) {
    command.add_option("--time-step", a.time_step, "Which time step")->check(CLI::NonNegativeNumber);
    command.add_option("--time-steps", a.time_steps, "all, FIRST:LAST or FIRST:LAST:STRIDE: a picture of each of these steps");
    command.add_option("--phases", a.phases, "That many pictures over one period of the warp's phase")
        ->check(CLI::Range(1, 1000000));
    command.add_option("--turntable", a.turntable, "That many pictures with the eye once around the point looked at")
        ->check(CLI::Range(1, 1000000));
    command.add_option("--turntable-axis", a.turntable_axis, "x,y,z that the eye goes around; by default the camera's up");
    command.add_option("--film", a.film, "Also make a film of the pictures, such as FILM.mp4; needs ffmpeg");
    command.add_option("--frames-a-second", a.frames_a_second, "Of the film; 25 by default")->check(CLI::PositiveNumber);
    command.add_flag("--resume", a.resume, "Keep pictures of the animation that are there already");
}

void add_output(CLI::App& command, RenderArguments& a) {
    command.add_option("--buffers", a.buffers,
                       "HDF5 file with what the picture is made of, per pixel; of several scenes a folder");
    command.add_option("--stats", a.stats, "JSON file with times and counts; of several scenes a folder");
    command.add_option("--share", a.share,
                       "What passes take from each other, to compare times: all, none, depths or rows (the default)");
    command.add_option("--repeat", a.repeat, "Draw the frame that many times more, and put the times into --stats")
        ->check(CLI::NonNegativeNumber);
    command.add_option(
        "--parts", a.parts,
        "N: draw the volume in that many parts, one after the other, as elvis-mpi does with many processes; FILE: "
        "in those that it gives each element, as gpmetis writes them; own: in those of the solver that wrote the data");
    command.add_option("--device-memory", a.device_memory,
                       "Size, such as 2G: the most that pictures may take on the device; only elements that they need are "
                       "read and uploaded");
    command.add_option("--host-memory", a.host_memory, "The same on the host");
    command.add_option("--bits", a.bits, "Bits a channel: 8 or 16")->check(CLI::IsMember({8, 16}));
    command.add_flag("--validation", a.validation, "Run with the Vulkan validation layer; any message is an error");
    command.add_flag("--schema", a.schema, "Print the JSON Schema of scene files");
}

} // namespace

void add_render(CLI::App& app, DivisibleTeam* team) {
    CLI::App* command = app.add_subcommand("render", "Draw pictures of a volume, or an animation, from scene files or options");
    auto a = std::make_shared<RenderArguments>();
    a->team = team;
    add_surfaces(*command, *a);
    add_volume(*command, *a);
    add_join(*command, a->joins);
    add_warp(*command, a->warp);
    command->add_flag("--undeformed-edges", a->undeformed_edges,
                      "Draw the edges of the boundary where they are without the warp, too, in gray");
    command->add_option("--streamlines", a->streamlines,
                        "Tubes along this vector field, from a grid of points; a scene says more about them");
    CLI::Option* const arrows = command->add_option(
        "--arrows", a->arrows, "Arrows of this vector field, on the surfaces of the command line, or else in the volume");
    command->add_option("--arrow-spacing", a->arrow_spacing, "Distance between them; default: 0.05 of the bounds' diagonal")
        ->needs(arrows)
        ->check(CLI::PositiveNumber)
        ->check(finite_number());
    command->add_option("--pathlines", a->pathlines,
                        "Tubes along the ways of points that move with this vector field through all time steps");
    command
        ->add_option("--ribbons", a->ribbon_width,
                     "--streamlines and --pathlines are ribbons of this width, which turn with the flow, in place of tubes")
        ->check(CLI::PositiveNumber)
        ->check(finite_number());
    add_lines_and_colors(*command, *a);
    add_camera(*command, *a);
    add_picture(*command, *a);
    add_animation(*command, *a);
    add_output(*command, *a);
    command->callback([a, command] {
        a->boundary = command->count("--boundary") > 0;
        a->has_contours = command->count("--contours") > 0;
        if (a->contours == "{}") {
            a->contours.clear(); // What the option's library takes no value for.
        }
        // Without a name the list holds an empty one.
        std::erase_if(a->boundary_groups, [](const std::string& name) { return name.empty() || name == "{}"; });
        run(*a);
    });
}

} // namespace elvis::commands
