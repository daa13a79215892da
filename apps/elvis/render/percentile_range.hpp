/**
 * @file percentile_range.hpp
 * The colour map's range as `--range 2%,98%` says.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/base/team.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/scene/scene.hpp>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <span>
#include <vector>

namespace elvis::commands {

/** Takes it for the scene's. Throws Error where colours cannot go by it. */
void take_range(std::span<const double> range, nlohmann::json& scene);

/** Values below which these parts of the volume lie, over all time steps that the scene shows; found by the first of the team.
 */
std::vector<double> percentiles_of_first(const Scene& scene, const RuntimeVolume& whole, const std::array<double, 2>& parts,
                                         Team& team, const TaskControl& control);

} // namespace elvis::commands
