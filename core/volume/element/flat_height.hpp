/**
 * @file flat_height.hpp
 * Volumes of two dimensions that lie in a plane.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>

#include <optional>

namespace elvis {

/** A point this far from an element of two dimensions, as a share of its size, counts as on it. */
inline constexpr double on_surface = 1e-6;

/** The z of all elements of a volume of two dimensions, to on_surface of its size; none of other volumes. */
std::optional<double> flat_height(const RuntimeVolume& volume);

} // namespace elvis
