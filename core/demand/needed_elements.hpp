/**
 * @file needed_elements.hpp
 * Which elements a surface of a picture needs: all others could be missing, and the picture would be the same to the bit.
 */
#pragma once

#include <core/demand/box_blocks.hpp>
#include <core/demand/demand_ranges.hpp>
#include <core/render/frame.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

/**
 * Whether a box may hold a point of the plane that the picture shows, or comes near to one. `bounds`: of the whole volume,
 * whose diagonal tells what is near.
 */
std::function<bool(const ElementBox&)> meets_plane_in_view(const CutPlane& plane, const FrameRequest& request,
                                                           const ElementBox& bounds);

/** Why what the picture shows needs all elements, for people; nothing if some are enough. */
std::optional<std::string> needs_all(const FrameRequest& request, const RuntimeVolume& whole, DemandRanges& ranges);

/**
 * Those that the surface needs, ascending; needs_all() is nothing. `rows`: the picture, or some rows of it. Throws
 * TooManyElements.
 */
std::vector<std::uint64_t> needed_elements(const Surface& surface, const FrameRequest& rows, const RuntimeVolume& whole,
                                           const BoxBlocks& blocks, DemandRanges& ranges, std::uint64_t most,
                                           const TaskControl* control);

} // namespace elvis
