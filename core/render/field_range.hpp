/**
 * @file field_range.hpp
 * Range of a field over a volume.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/device_volume.hpp>

#include <vector>

namespace elvis {

/** Range of every component over all elements, from the plugin. Needs RuntimeVolume::has_field_ranges(). */
std::vector<FieldRange> ranges_from_plugin(const RuntimeVolume& volume, std::uint32_t field, std::uint32_t time_step,
                                           elvis_certainty& certainty);

/**
 * The same from samples on the device, for the field that `data` has selected without offset, or the expression, which is one
 * number: seven points along each collapsed direction of every element, faces included. An estimate.
 */
std::vector<FieldRange> ranges_from_samples(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                                            std::uint32_t n_components);

/** About what rounding costs the selected expression in the precision of `data`: the largest of samples. */
double rounding_of_expression(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                              const Expression& expression);

} // namespace elvis
