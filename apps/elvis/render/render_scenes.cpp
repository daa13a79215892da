#include "render_scenes.hpp"
#include "output_endings.hpp"
#include "render_animation.hpp"
#include "render_session.hpp"
#include "say_remarks.hpp"

#include <core/annotation/font.hpp>
#include <core/base/error.hpp>
#include <core/base/milliseconds.hpp>
#include <core/scene/output/buffers_file.hpp>
#include <core/scene/output/output_file.hpp>
#include <core/scene/output/png_file.hpp>
#include <core/session/field_samples.hpp>
#include <core/session/picture_stats.hpp>
#include <core/session/still_picture.hpp>

#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <set>

namespace elvis::commands {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/** A scene, and what is wanted of it. */
struct Task {
    RenderArguments arguments;
    Scene scene;
};

/** Before the work is done: whether the files can be what their names say. */
void check_names(const RenderArguments& arguments, const Scene& scene) {
    if (!scene.animation) {
        need_picture_ending("--output", arguments.output);
    }
    if (!arguments.buffers.empty()) {
        need_hdf5_ending("--buffers", arguments.buffers);
    }
    if (!arguments.stats.empty()) {
        need_ending("--stats", arguments.stats, {".json"});
    }
}

/** The name of a scene's file in a folder that an option names; none if the option is not given. */
std::string in_folder(const char* option, const std::string& folder, const fs::path& name) {
    if (folder.empty()) {
        return {};
    }
    if (fs::exists(folder) && !fs::is_directory(folder)) {
        throw UsageError(option, "'" + folder + "' is a file; what several scenes write goes into a folder");
    }
    return (fs::path(folder) / name).string();
}

/** What each of several scenes writes has its name. */
void choose_names(Task& task) {
    const std::string name = fs::path(task.arguments.input).stem().string();
    RenderArguments& own = task.arguments;
    own.output = in_folder("--output", own.output, task.scene.animation ? name : name + ".png");
    own.buffers = in_folder("--buffers", own.buffers, name + ".h5");
    own.stats = in_folder("--stats", own.stats, name + ".json");
}

Task read_task(const RenderArguments& arguments, const std::string& input) {
    Task task{arguments, {}};
    task.arguments.input = input;
    if (is_scene(input)) {
        task.scene = read_scene(input);
    } else {
        task.scene.volume = input;
    }
    apply_options(task.arguments, task.scene);
    if (arguments.inputs.size() > 1) {
        choose_names(task);
    }
    check_animation(task.arguments, task.scene);
    check_names(task.arguments, task.scene);
    if (task.scene.volume.empty()) {
        throw Error(input, "'volume' is missing");
    }
    if (task.scene.annotation) {
        // Before the work is done: is there a font?
        const Font font(task.scene.annotation->style.font);
    }
    return task;
}

/** Throws unless all are scenes whose files are not each other's. */
void check_inputs(const RenderArguments& arguments) {
    std::set<fs::path> names;
    for (const std::string& input : arguments.inputs) {
        if (!is_scene(input)) {
            throw UsageError("render", "'" + input + "' is one of several inputs, and no scene file (.json)");
        }
        if (!names.insert(fs::path(input).stem()).second) {
            throw UsageError("render", "'" + input + "' has the name of another scene: one picture would replace the other");
        }
    }
    if (!arguments.film.empty()) {
        throw UsageError("--film", "is of one scene, not of several");
    }
}

std::vector<Task> read_tasks(const RenderArguments& arguments) {
    if (arguments.inputs.size() > 1) {
        check_inputs(arguments);
    }
    std::vector<Task> tasks;
    for (const std::string& input : arguments.inputs) {
        tasks.push_back(read_task(arguments, input));
    }
    return tasks;
}

/** The colour map's range by --range 2%,98%. */
void choose_range(const RenderArguments& arguments, Scene& scene, RenderSession& session) {
    const auto percentiles = percentiles_of(arguments);
    if (!percentiles) {
        return;
    }
    scene.range_steps = scene.animation ? drawn_steps(scene, session.volume()) : std::vector<std::uint32_t>{};
    scene.color_map.range = percentile_range(scene, session.volume(), session.renderer().ranges().bounds(), *percentiles);
    if (scene.color_map.is_logarithmic && !((*scene.color_map.range)[0] > 0)) {
        throw Error("--range", "the lower percentile is not above 0, as it must be on a logarithmic scale");
    }
    spdlog::info("range: {:.6g} to {:.6g}", (*scene.color_map.range)[0], (*scene.color_map.range)[1]);
}

void render_picture(const RenderArguments& arguments, const Scene& scene, RenderSession& session, Clock::time_point start) {
    Renderer& renderer = session.renderer();
    const Precision precision = scene.precision.value_or(Precision::float32);
    const bool with_buffers = !arguments.buffers.empty();
    const StillPicture still = draw_still(scene, session.volume(), renderer, {with_buffers, sharing_of(arguments)});
    say(still.remarks);
    std::vector<double> repeated;
    for (int repetition = 0; repetition < arguments.repeat; ++repetition) {
        const Clock::time_point frame_start = Clock::now();
        renderer.render(still.request);
        repeated.push_back(milliseconds_since(frame_start));
    }
    write_png(still.frame, arguments.output, arguments.bits);
    if (with_buffers) {
        write_buffers(still.frame, still.request, session.volume(), arguments.buffers, precision);
    }
    if (!arguments.stats.empty()) {
        const auto stats = stats_json(session.device(), precision, still.frame, renderer, session.load_milliseconds(),
                                      milliseconds_since(start), repeated);
        write_text_file(arguments.stats, stats.dump(2) + "\n");
    }
}

void render_task(Task& task, RenderSession& session, Clock::time_point start) {
    session.open(task.scene);
    choose_range(task.arguments, task.scene, session);
    if (task.scene.animation) {
        render_animation(task.arguments, task.scene, session.device(), session.volume(), session.renderer());
    } else {
        render_picture(task.arguments, task.scene, session, start);
    }
}

} // namespace

void render_scenes(const RenderArguments& arguments) {
    Clock::time_point start = Clock::now();
    std::vector<Task> tasks = read_tasks(arguments);
    if (tasks.size() > 1) {
        for (const std::string& folder : {arguments.output, arguments.buffers, arguments.stats}) {
            if (!folder.empty()) {
                fs::create_directories(folder);
            }
        }
    }
    RenderSession session(arguments);
    for (Task& task : tasks) {
        if (tasks.size() > 1) {
            spdlog::info("scene: {}", task.arguments.input);
        }
        render_task(task, session, start);
        start = Clock::now();
    }
    if (arguments.validation && !session.device().validation_messages().empty()) {
        throw Error("validation layer", session.device().validation_messages().front());
    }
}

} // namespace elvis::commands
