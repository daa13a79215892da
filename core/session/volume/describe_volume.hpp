/**
 * @file describe_volume.hpp
 * What is in a volume, as JSON: what `elvis info --json` prints.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/session/volume/extrema_finder.hpp>
#include <core/volume/element/jacobian_check.hpp>

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <utility>

namespace elvis {

struct DescribeOptions {
    std::uint32_t time_step = 0;
    /** See check_jacobians. */
    double jacobian_tolerance = default_jacobian_tolerance;
    /** All elements of lists, not the first twenty. */
    bool lists_all = false;
    /** Without what takes long: ranges of fields, Jacobians, overlaps. */
    bool is_brief = false;
    /** With points far out all around (core/volume/outline.hpp). */
    bool with_outline = false;
};

/** min x y z, max x y z of all elements, and how sure that is. */
std::pair<std::array<double, 6>, elvis_certainty> bounds_of(const RuntimeVolume& volume);

/** Ranges that cannot be found are told with the reason. An Error if there is no such time step. */
nlohmann::ordered_json describe_volume(const RuntimeVolume& volume, const DescribeOptions& options, ExtremaFinder& extrema);

} // namespace elvis
