#include "render_on_demand.hpp"
#include "native_volume.hpp"

#include <core/base/error.hpp>
#include <core/base/milliseconds.hpp>
#include <core/base/output_file.hpp>
#include <core/demand/draw_on_demand.hpp>
#include <core/scene/output/buffers_file.hpp>
#include <core/scene/output/png_file.hpp>
#include <core/session/picture_stats.hpp>
#include <core/session/volume/open_volume.hpp>
#include <core/session/volume/warped.hpp>

#include <nlohmann/json.hpp>
#include <spdlog/spdlog.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace elvis::commands {

namespace {

using BudgetClock = std::chrono::steady_clock;

/** "2G", "1.5G", "800M", "65536K" or bytes; nothing for no text. */
std::optional<std::uint64_t> size_of(const std::string& option, const std::string& text) {
    if (text.empty()) {
        return {};
    }
    double number = 0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    const std::string unit(end, text.data() + text.size());
    const std::string units = "KMGT";
    const std::size_t power = unit.size() == 1 ? units.find(unit) : std::string::npos;
    if (failure != std::errc() || !(number > 0) || !(unit.empty() || power != std::string::npos) ||
        !(std::ldexp(number, 40) < 1e30)) {
        throw UsageError(option, "'" + text + "' is no size; sizes are bytes, or numbers with K, M, G or T, such as 2G");
    }
    return static_cast<std::uint64_t>(std::ldexp(number, unit.empty() ? 0 : 10 * static_cast<int>(power + 1)));
}

MemoryBudget budget_of(const RenderArguments& arguments) {
    return {size_of("--device-memory", arguments.device_memory), size_of("--host-memory", arguments.host_memory)};
}

/** A volume, and the files that it lies in, which may be temporary. */
struct OpenedVolume {
    std::vector<VolumeFile> files;
    RuntimeVolume whole;
};

OpenedVolume open_volume_of(const Scene& scene, const PluginRegistry& plugins, const TaskControl& control) {
    std::vector<std::string> paths{scene.volume};
    paths.insert(paths.end(), scene.more_files.begin(), scene.more_files.end());
    VolumeFile file = find_volume(plugins, paths, scene.plugin, scene.plugin_options, control);
    if (!scene.warp && scene.joined.empty()) {
        RuntimeVolume whole = file.open(&control);
        return {{std::move(file)}, std::move(whole)};
    }
    if (file.plugin->id() != native_plugin_id) {
        throw Error(scene.volume,
                    "is no native volume, nor converted to one: within a budget of memory it is not displaced, and "
                    "nothing is joined to it");
    }
    OneProcess alone;
    NativeVolume native = open_native(scene, plugins, alone, control);
    return {std::move(native.files), std::move(native.whole)};
}

std::string demand_stats(const StillPicture& still, const DemandWork& work, const Device& device, Precision precision,
                         BudgetClock::time_point start) {
    auto stats = nlohmann::ordered_json::parse(PictureStats(device, precision, still.frame).json());
    stats["milliseconds"]["total"] = milliseconds_since(start);
    stats["demand"] = {{"elements", work.n_elements},
                       {"elements_on_device", work.n_on_device},
                       {"bands", work.n_bands},
                       {"device_bytes", work.device_bytes},
                       {"peak_memory_bytes", work.host_bytes},
                       {"bounds_milliseconds", work.bounds_milliseconds}};
    return stats.dump(2) + "\n";
}

} // namespace

bool has_budget(const RenderArguments& arguments) { return !arguments.device_memory.empty() || !arguments.host_memory.empty(); }

void check_budget(const RenderArguments& arguments, bool is_animation) {
    if (!has_budget(arguments)) {
        return;
    }
    budget_of(arguments);
    const std::string option = arguments.device_memory.empty() ? "--host-memory" : "--device-memory";
    for (const auto& [other, is_given] :
         {std::pair{"--parts", !arguments.parts.empty()}, std::pair{"--devices", !arguments.devices.empty()},
          std::pair{"--repeat", arguments.repeat > 0}, std::pair{"--share", !arguments.share.empty()},
          std::pair{"--range in percent", percentiles_of(arguments).has_value()}, std::pair{"an animation", is_animation}}) {
        if (is_given) {
            throw UsageError(option, std::string("does not go with ") + other);
        }
    }
}

void render_on_demand(const RenderArguments& arguments, const scene& shown) {
    const BudgetClock::time_point start = BudgetClock::now();
    Scene scene = scene_of(nlohmann::json::parse(shown.json()), arguments.is_scene ? arguments.input : "scene");
    const TaskControl control;
    const PluginRegistry plugins;
    const OpenedVolume opened = open_volume_of(scene, plugins, control);
    const RuntimeVolume& whole = opened.whole;
    scene.volume = whole.path();
    const Precision precision = scene.precision.value_or(Precision::float32);
    const Device device(arguments.device, arguments.validation);
    VolumeOnDemand demand(whole, device, precision, budget_of(arguments), &control);
    const StillPicture still = demand.draw(scene);
    for (const FrameRemark& remark : still.remarks) {
        spdlog::log(remark.is_warning ? spdlog::level::warn : spdlog::level::info, "{}", remark.text);
    }
    write_png(still.frame, arguments.output, arguments.bits);
    if (!arguments.buffers.empty()) {
        write_buffers(still.frame, still.request, whole, arguments.buffers, precision);
    }
    if (!arguments.stats.empty()) {
        write_text_file(arguments.stats, demand_stats(still, demand.work(), device, precision, start));
    }
}

} // namespace elvis::commands
