/**
 * @file sampled_range.hpp
 * Range of a field from samples on the device: where a plugin neither tells it nor evaluates on the CPU, of elements that are
 * only parts of their reference shape, and of expressions. An estimate, always.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/device_volume.hpp>

#include <vector>

namespace elvis {

/**
 * Range of every component over all elements, for the field that `data` has selected without offset, or the expression, which
 * is one number: seven points along each collapsed direction of every element, faces included.
 */
std::vector<FieldRange> ranges_from_samples(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                                            std::uint32_t n_components);

/**
 * Extrema of a component, of the magnitude (-1) of a field with several, or of the expression (0), for what `data` has selected
 * without offset: the same samples, refined around those that are among the best. Bounds are the values themselves. Without any
 * finite value the minimum is above the maximum.
 */
FieldExtrema extrema_from_samples(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data, int component,
                                  std::uint32_t n_components);

} // namespace elvis
