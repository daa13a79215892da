/**
 * @file percentile_range.hpp
 * The colour map's range as `--range 2%,98%` says.
 */
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <span>

namespace elvis::commands {

/** The scene takes it. Throws Error where colours cannot go by it. */
void take_range(std::span<const double> range, nlohmann::json& scene);

} // namespace elvis::commands
