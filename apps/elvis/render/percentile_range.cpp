#include "percentile_range.hpp"

#include <core/base/error.hpp>

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

} // namespace elvis::commands
