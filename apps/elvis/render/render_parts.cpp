#include "render_parts.hpp"

#include <core/base/error.hpp>
#include <core/base/milliseconds.hpp>
#include <core/base/output_file.hpp>
#include <core/parts/draw_in_parts.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/scene/output/buffers_file.hpp>
#include <core/scene/output/png_file.hpp>
#include <core/session/open_volume.hpp>
#include <core/session/picture_stats.hpp>
#include <core/session/warped.hpp>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>
#include <vector>

namespace elvis::commands {

namespace {

using Clock = std::chrono::steady_clock;

/** A native volume: what its numbers come from, and the volume that serves them. */
struct NativeVolume {
    VolumeFile file;
    std::shared_ptr<const native::VolumeSource> source;
    RuntimeVolume whole;
};

VolumeFile find_file(const Scene& scene, const PluginRegistry& plugins, Team& team, const TaskControl& control) {
    std::vector<std::string> files{scene.volume};
    files.insert(files.end(), scene.more_files.begin(), scene.more_files.end());
    const auto find = [&] { return find_volume(plugins, files, scene.plugin, scene.plugin_options, control); };
    // What has to be converted, the first converts; the others then find it in the cache.
    std::optional<VolumeFile> file;
    if (team.is_first()) {
        file = find();
    }
    double no_number = 0;
    team.minimum(std::span(&no_number, 1));
    if (!file) {
        file = find();
    }
    if (file->plugin->id() != native_plugin_id) {
        throw Error(scene.volume, "only native volumes, and what is converted to them, are drawn in parts; this is one of " +
                                      file->plugin->id() + " (elvis convert makes native volumes)");
    }
    return *file;
}

NativeVolume open_native(const Scene& scene, const PluginRegistry& plugins, Team& team, const TaskControl& control) {
    VolumeFile file = find_file(scene, plugins, team, control);
    std::shared_ptr<const native::VolumeSource> source = native_source(file.path);
    if (!scene.warp) {
        RuntimeVolume whole = file.open(&control);
        return {std::move(file), std::move(source), std::move(whole)};
    }
    auto displaced = warped_source(std::move(source), *scene.warp, scene.time_step, file.path);
    RuntimeVolume whole = serve_native(displaced, file.path, &control);
    return {std::move(file), std::move(displaced), std::move(whole)};
}

nlohmann::ordered_json work_json(const std::vector<PartsWork>& work) {
    nlohmann::ordered_json ranks = nlohmann::ordered_json::array();
    for (const PartsWork& one : work) {
        ranks.push_back({{"rank", one.rank},
                         {"parts", one.n_parts},
                         {"own_elements", one.n_own_elements},
                         {"elements", one.n_elements},
                         {"device_bytes", one.device_bytes},
                         {"picture_bytes", one.picture_bytes},
                         {"peak_memory_bytes", one.peak_memory_bytes}});
    }
    return ranks;
}

std::string stats_of(const PartsPicture& picture, const Device& device, Precision precision, int n_parts,
                     Clock::time_point start) {
    auto stats = nlohmann::ordered_json::parse(PictureStats(device, precision, picture.still.frame).json());
    stats["milliseconds"]["total"] = milliseconds_since(start);
    stats["parts"] = {{"count", n_parts},
                      {"runs", picture.n_runs},
                      {"fold_milliseconds", picture.fold_milliseconds},
                      {"ranks", work_json(picture.work)}};
    return stats.dump(2) + "\n";
}

void tell(const std::vector<FrameRemark>& remarks) {
    for (const FrameRemark& remark : remarks) {
        spdlog::log(remark.is_warning ? spdlog::level::warn : spdlog::level::info, "{}", remark.text);
    }
}

} // namespace

void check_parts(const RenderArguments& arguments, bool is_animation) {
    if (arguments.parts == 0) {
        if (arguments.team != nullptr) {
            throw UsageError("render", "needs --parts N: processes draw parts of the volume");
        }
        return;
    }
    for (const auto& [option, is_given] :
         {std::pair{"--devices", !arguments.devices.empty()}, std::pair{"--repeat", arguments.repeat > 0},
          std::pair{"--share", !arguments.share.empty()}, std::pair{"--range", percentiles_of(arguments).has_value()}}) {
        if (is_given) {
            const bool is_range = std::string(option) == "--range";
            throw UsageError(option,
                             is_range ? "in percent does not go with --parts: give values" : "does not go with --parts");
        }
    }
    if (is_animation) {
        throw UsageError("--parts", "is of single pictures, not of animations");
    }
}

void render_parts(const RenderArguments& arguments, const scene& shown) {
    const Clock::time_point start = Clock::now();
    OneProcess alone;
    Team& team = arguments.team != nullptr ? *arguments.team : static_cast<Team&>(alone);
    Scene scene = scene_of(nlohmann::json::parse(shown.json()), arguments.is_scene ? arguments.input : "scene");
    need_parts_can_draw(scene);
    const TaskControl control;
    const PluginRegistry plugins;
    const NativeVolume volume = open_native(scene, plugins, team, control);
    scene.volume = volume.whole.path();
    const Precision precision = scene.precision.value_or(Precision::float32);
    const Device device(arguments.device, arguments.validation);
    VolumeInParts parts(volume.source, volume.whole, device, precision,
                        Partition::in_shares(volume.whole.n_elements(), static_cast<std::uint32_t>(arguments.parts)), team,
                        &control);
    const PartsPicture picture = parts.draw(scene);
    if (!team.is_first()) {
        return;
    }
    tell(picture.still.remarks);
    const Frame& frame = picture.still.frame;
    write_png(frame, arguments.output, arguments.bits);
    if (!arguments.buffers.empty()) {
        write_buffers(frame, picture.still.request, volume.whole, arguments.buffers, precision);
    }
    if (!arguments.stats.empty()) {
        write_text_file(arguments.stats, stats_of(picture, device, precision, arguments.parts, start));
    }
}

} // namespace elvis::commands
