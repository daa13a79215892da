/**
 * @file field_range.hpp
 * Range of a field over a volume as the plugin tells it, and what rounding costs an expression.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/volume/device_volume.hpp>

#include <functional>
#include <vector>

namespace elvis {

/**
 * Range of every component over all elements, from the plugin. Needs RuntimeVolume::has_field_ranges().
 * `check` may throw, and is asked on the way. */
std::vector<FieldRange> ranges_from_plugin(Background& background, const RuntimeVolume& volume, std::uint32_t field,
                                           std::uint32_t time_step, elvis_certainty& certainty,
                                           const std::function<void()>& check = {});

/** Elements of a class in which rounding is sampled, at most: every so many of them, from the first on. Enough to meet what is
 * large, and no more than a picture costs. */
inline constexpr std::uint32_t expression_error_samples = 2048;
/** About what rounding costs the selected expression in the precision of `data`: the largest of samples. */
double rounding_of_expression(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data,
                              const Expression& expression);

} // namespace elvis
