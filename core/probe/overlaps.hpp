/**
 * @file overlaps.hpp
 * Which elements lie in parts of others: of a valid mesh none.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/base/cancel.hpp>
#include <core/hierarchy/hierarchy.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** Whether the plugin evaluates mappings on the CPU, and elements are all of their reference shapes. */
bool can_find_overlaps(const RuntimeVolume& volume);

/**
 * Elements that hold points of others by more than rounding, and those others, ascending; needs can_find_overlaps(). Estimated:
 * what overlaps between samples is missed, and what overlaps by less than a thousandth of an element.
 */
std::vector<std::uint64_t> overlapping_elements(const RuntimeVolume& volume, const TaskControl* control = nullptr);
/** The same with the hierarchies of the elements of each class. */
std::vector<std::uint64_t> overlapping_elements(const RuntimeVolume& volume, std::span<const Hierarchy* const> hierarchies,
                                                Background& background, const TaskControl* control);

} // namespace elvis
