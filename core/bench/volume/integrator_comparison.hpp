/**
 * @file integrator_comparison.hpp
 * Which integrator comes to an error of 0.001 first.
 */
#pragma once

#include <core/bench/volume/volume_convergence.hpp>

namespace elvis {

/** Gives a row for each integrator and transfer function, in pictures of so many pixels a side. */
void compare_integrators(const Device& device, const std::string& name, const RuntimeVolume& volume, std::uint32_t size,
                         double unit_nanoseconds, const std::function<void(const ComparisonRow&)>& report);

} // namespace elvis
