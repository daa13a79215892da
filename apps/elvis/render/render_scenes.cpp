#include "render_scenes.hpp"
#include "output_endings.hpp"
#include "part_choice.hpp"
#include "percentile_range.hpp"
#include "render_animation.hpp"
#include "render_parts.hpp"
#include "render_session.hpp"
#include "say_remarks.hpp"
#include <apps/elvis/library_context.hpp>
#include <apps/elvis/long_task.hpp>

#include <core/base/error.hpp>
#include <core/base/milliseconds.hpp>
#include <core/base/output_file.hpp>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <set>

namespace elvis::commands {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Clock = std::chrono::steady_clock;

/** A scene, and what is wanted of it. */
struct Wanted {
    RenderArguments arguments;
    scene shown;
    bool is_animation = false;
};

/** Before the work is done: whether the files can be what their names say. */
void check_names(const Wanted& wanted) {
    const RenderArguments& arguments = wanted.arguments;
    if (!wanted.is_animation) {
        arguments.parts.empty() ? need_still_ending("--output", arguments.output)
                                : need_picture_ending("--output", arguments.output);
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
void choose_names(Wanted& wanted) {
    RenderArguments& own = wanted.arguments;
    const std::string name = fs::path(own.input).stem().string();
    own.output = in_folder("--output", own.output, wanted.is_animation ? name : name + ".png");
    own.buffers = in_folder("--buffers", own.buffers, name + ".h5");
    own.stats = in_folder("--stats", own.stats, name + ".json");
}

/** A scene file's scene, or one that says nothing but the volume. */
scene scene_of(const context& library, const RenderArguments& arguments) {
    if (arguments.is_scene) {
        return library.read_scene(arguments.input);
    }
    scene made = library.make_scene();
    made.set("/volume/path", json(arguments.input).dump());
    if (!arguments.more_inputs.empty()) {
        made.set("/volume/more_paths", json(arguments.more_inputs).dump());
    }
    return made;
}

bool is_scene(const context& library, const std::string& input) {
    return fs::exists(input) && json::parse(library.describe_file(input))["kind"] == "scene";
}

/** What does not go with a budget of memory, which an option or the scene gives. */
void check_budget(const Wanted& wanted) {
    const RenderArguments& arguments = wanted.arguments;
    if (!json::parse(wanted.shown.json()).contains("memory")) {
        return;
    }
    for (const auto& [other, is_given] :
         {std::pair{"--parts", !arguments.parts.empty()}, std::pair{"--devices", !arguments.devices.empty()},
          std::pair{"--range in percent", percentiles_of(arguments).has_value()}}) {
        if (is_given) {
            const std::string option = arguments.device_memory.empty() ? "--host-memory" : "--device-memory";
            const bool is_by_option = !arguments.device_memory.empty() || !arguments.host_memory.empty();
            throw UsageError(is_by_option ? option : "'memory' of the scene", std::string("does not go with ") + other);
        }
    }
}

Wanted read_wanted(const context& library, const RenderArguments& all, const std::string& input) {
    RenderArguments arguments = all;
    arguments.input = input;
    arguments.is_scene = is_scene(library, input);
    scene shown = scene_of(library, arguments);
    apply_options(arguments, shown);
    const bool is_animation = json::parse(shown.json()).contains("animation");
    Wanted wanted{std::move(arguments), std::move(shown), is_animation};
    if (all.inputs.size() > 1 && wanted.arguments.is_scene) {
        choose_names(wanted);
    }
    if (is_animation) {
        check_animation(wanted.arguments);
    }
    check_parts(wanted.arguments, is_animation);
    check_budget(wanted);
    check_names(wanted);
    if (wanted.shown.volume().empty()) {
        throw Error(input, "'volume' is missing");
    }
    return wanted;
}

/** The same of a file that may be nothing by itself. */
bool may_be_scene(const context& library, const std::string& input) {
    try {
        return is_scene(library, input);
    } catch (const error&) {
        return false;
    }
}

/** Several files that are one foreign data set. */
Wanted read_data_set(const context& library, RenderArguments arguments) {
    for (const std::string& input : arguments.inputs) {
        if (may_be_scene(library, input)) {
            throw UsageError("render", "'" + input + "' is a scene, and '" + arguments.inputs.front() +
                                           "' before it is none: files of one data set, or scenes, are drawn together");
        }
    }
    const std::string first = arguments.inputs.front();
    arguments.more_inputs.assign(arguments.inputs.begin() + 1, arguments.inputs.end());
    return read_wanted(library, arguments, first);
}

/** Throws unless all are scenes whose files are not each other's. */
void check_inputs(const context& library, const RenderArguments& arguments) {
    std::set<fs::path> names;
    for (const std::string& input : arguments.inputs) {
        if (!is_scene(library, input)) {
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

std::vector<Wanted> read_all(const context& library, const RenderArguments& arguments) {
    std::vector<Wanted> all;
    if (arguments.inputs.size() > 1 && !is_scene(library, arguments.inputs.front())) {
        all.push_back(read_data_set(library, arguments));
        return all;
    }
    if (arguments.inputs.size() > 1) {
        check_inputs(library, arguments);
    }
    for (const std::string& input : arguments.inputs) {
        all.push_back(read_wanted(library, arguments, input));
    }
    return all;
}

/** The colour map's range by --range 2%,98%. */
void choose_range(Wanted& wanted, const data& volume, const task& watch) {
    const auto parts = percentiles_of(wanted.arguments);
    if (!parts) {
        return;
    }
    const std::vector<double> range = volume.percentiles(wanted.shown, {(*parts)[0], (*parts)[1]}, watch);
    json with_range = json::parse(wanted.shown.json());
    take_range(range, with_range);
    wanted.shown.set("/color_map/range", with_range["color_map"]["range"].dump());
    spdlog::info("range: {:.6g} to {:.6g}", range[0], range[1]);
}

/** What the picture took, and what only the program knows. */
std::string stats_of(const picture& drawn, double load, double total, const std::vector<double>& repeated) {
    auto stats = nlohmann::ordered_json::parse(drawn.stats());
    stats["milliseconds"]["load"] = load;
    stats["milliseconds"]["total"] = total;
    if (!repeated.empty()) {
        stats["frame_milliseconds"] = repeated;
    }
    return stats.dump(2) + "\n";
}

void render_picture(const Wanted& wanted, const data& volume, double load_milliseconds, const task& watch,
                    Clock::time_point start) {
    const RenderArguments& arguments = wanted.arguments;
    auto options = detail::sized<elvis_render_options>();
    options.flags = sharing_of(arguments) | (arguments.buffers.empty() ? ELVIS_RENDER_COLOR_ONLY : 0u);
    const picture drawn = volume.render(wanted.shown, options, watch);
    say(drawn.remarks());
    std::vector<double> repeated;
    for (int repetition = 0; repetition < arguments.repeat; ++repetition) {
        const Clock::time_point frame_start = Clock::now();
        volume.render(wanted.shown, options, watch);
        repeated.push_back(milliseconds_since(frame_start));
    }
    write_still(drawn, arguments.output, static_cast<std::uint32_t>(arguments.bits));
    if (!arguments.buffers.empty()) {
        drawn.write_buffers(arguments.buffers);
    }
    if (!arguments.stats.empty()) {
        write_text_file(arguments.stats, stats_of(drawn, load_milliseconds, milliseconds_since(start), repeated));
    }
}

void render_one(Wanted& wanted, RenderSession& session, const task& watch, Clock::time_point start) {
    const data& volume = session.open(wanted.shown);
    choose_range(wanted, volume, watch);
    if (wanted.is_animation) {
        render_animation(wanted.arguments, wanted.shown, volume, session.library());
    } else {
        render_picture(wanted, volume, session.load_milliseconds(), watch, start);
    }
}

context context_for(const RenderArguments& arguments) {
    const bool has_several = !arguments.devices.empty();
    return library_context(has_several ? arguments.devices : arguments.device,
                           (arguments.validation ? ELVIS_CONTEXT_VALIDATION : 0u) |
                               (has_several ? ELVIS_CONTEXT_SEVERAL_DEVICES : 0u));
}

} // namespace

void render_scenes(const RenderArguments& arguments) {
    Clock::time_point start = Clock::now();
    const context library = context_for(arguments);
    std::vector<Wanted> all = read_all(library, arguments);
    if (all.size() > 1) {
        for (const std::string& folder : {arguments.output, arguments.buffers, arguments.stats}) {
            if (!folder.empty()) {
                fs::create_directories(folder);
            }
        }
    }
    RenderSession session(library);
    for (Wanted& wanted : all) {
        if (all.size() > 1) {
            spdlog::info("scene: {}", wanted.arguments.input);
        }
        if (!arguments.parts.empty()) {
            render_parts(wanted.arguments, wanted.shown);
        } else {
            render_one(wanted, session, {}, start);
        }
        start = Clock::now();
    }
    if (arguments.validation) {
        const json messages = json::parse(library.describe_device())["validation_messages"];
        if (!messages.empty()) {
            throw Error("validation layer", messages[0].get<std::string>());
        }
    }
}

} // namespace elvis::commands
