#include "percentile_range.hpp"

#include <core/base/error.hpp>
#include <core/probe/probe.hpp>
#include <core/session/animation_pictures.hpp>
#include <core/session/volume/describe_volume.hpp>
#include <core/session/volume/field_samples.hpp>

#include <nlohmann/json.hpp>

#include <string>

namespace elvis::commands {

void take_range(std::span<const double> range, nlohmann::json& scene) {
    if (!(range[0] < range[1])) {
        throw Error("--range", "both percentiles are " + std::to_string(range[0]) + ": colours need a range of numbers here");
    }
    if (!(range[0] > 0) && scene.value(nlohmann::json::json_pointer("/color_map/scale"), "") == "logarithmic") {
        throw Error("--range", "the lower percentile is not above 0, as it must be on a logarithmic scale");
    }
    scene["color_map"]["range"] = range;
}

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

} // namespace elvis::commands
