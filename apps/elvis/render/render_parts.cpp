#include "render_parts.hpp"
#include "part_choice.hpp"
#include "parts_film.hpp"
#include "percentile_range.hpp"
#include "volume_to_part.hpp"

#include <core/base/milliseconds.hpp>
#include <core/base/output_file.hpp>
#include <core/parts/draw_in_parts.hpp>
#include <core/probe/probe.hpp>
#include <core/scene/output/buffers_file.hpp>
#include <core/scene/output/png_file.hpp>
#include <core/session/animation_pictures.hpp>
#include <core/session/picture_stats.hpp>
#include <core/session/volume/describe_volume.hpp>
#include <core/session/volume/field_samples.hpp>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <array>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

namespace elvis::commands {

namespace {

using Clock = std::chrono::steady_clock;

nlohmann::ordered_json work_json(const std::vector<PartsWork>& work) {
    nlohmann::ordered_json ranks = nlohmann::ordered_json::array();
    for (const PartsWork& one : work) {
        ranks.push_back({{"rank", one.rank},
                         {"parts", one.n_parts},
                         {"own_elements", one.n_own_elements},
                         {"elements", one.n_elements},
                         {"device_bytes", one.device_bytes},
                         {"picture_bytes", one.fold.sent_bytes},
                         {"received_bytes", one.fold.received_bytes},
                         {"runs", one.fold.n_runs},
                         {"fold_milliseconds", one.fold.milliseconds},
                         {"peak_memory_bytes", one.peak_memory_bytes}});
    }
    return ranks;
}

std::string stats_of(const PartsPicture& picture, const Device& device, Precision precision, std::uint32_t n_parts,
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

/** Which process draws with what. */
void name_devices(const Device& device, Team& team) {
    if (team.size() == 1) {
        return;
    }
    const auto name = std::as_bytes(std::span(device.summary().name));
    const std::vector<std::vector<std::byte>> names = team.gathered({name.begin(), name.end()});
    for (std::size_t rank = 0; rank < names.size(); ++rank) {
        spdlog::info("rank {} draws with {}", rank,
                     std::string_view(reinterpret_cast<const char*>(names[rank].data()), names[rank].size()));
    }
}

/** Values below which these parts of the volume lie, over all time steps that the scene shows; found by the first. */
std::vector<double> percentiles_of_first(const Scene& scene, const RuntimeVolume& whole, const std::array<double, 2>& parts,
                                         Team& team, const TaskControl& control) {
    std::vector<double> found;
    if (team.is_first()) {
        need_samples(whole);
        Scene shown = scene;
        shown.range_steps = steps_of_animation(shown, whole);
        Prober prober(whole);
        found = percentiles(prober, whole, bounds_of(whole).first, shown, parts, control);
    }
    return team.of_first(std::move(found));
}

} // namespace

void render_parts(const RenderArguments& arguments, const scene& shown) {
    const Clock::time_point start = Clock::now();
    OneProcess alone;
    DivisibleTeam& team = arguments.team != nullptr ? *arguments.team : static_cast<DivisibleTeam&>(alone);
    auto text = nlohmann::json::parse(shown.json());
    const std::string name = arguments.is_scene ? arguments.input : "scene";
    Scene scene = scene_of(text, name);
    need_parts_can_draw(scene);
    const TaskControl control;
    const PluginRegistry plugins;
    const VolumeToPart volume = open_to_part(scene, plugins, team, control);
    if (const auto parts = percentiles_of(arguments)) {
        const std::vector<double> range = percentiles_of_first(scene, volume.whole, *parts, team, control);
        take_range(range, text);
        scene = scene_of(text, name);
        spdlog::info("range: {:.6g} to {:.6g}", range[0], range[1]);
    }
    scene.volume = volume.whole.path();
    const Precision precision = scene.precision.value_or(Precision::float32);
    const Device device(arguments.device, arguments.validation);
    name_devices(device, team);
    Partition partition = partition_of(arguments, volume);
    const std::uint32_t n_parts = partition.n_parts();
    if (scene.animation) {
        render_parts_film(arguments, scene, volume, device, std::move(partition), team, control);
        return;
    }
    const std::unique_ptr<PartedVolume> parted = volume.parted(control);
    VolumeInParts parts(*parted, device, precision, std::move(partition), team, &control);
    const PartsPicture picture = parts.draw(scene, !arguments.buffers.empty());
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
        write_text_file(arguments.stats, stats_of(picture, device, precision, n_parts, start));
    }
}

} // namespace elvis::commands
