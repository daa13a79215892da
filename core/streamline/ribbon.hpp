/**
 * @file ribbon.hpp
 * Ribbons along streamlines, which turn with the flow.
 *
 * A ribbon lies across its line. It turns about the line's direction at the rate of half the vorticity's component along the
 * velocity (G. Volpe, "Streamlines and streamribbons in aerodynamics", AIAA 89-0140), beside what the line's own bending asks
 * for: the least rotation that keeps it across the line. In a rigid rotation it turns as the body does.
 */
#pragma once

#include <core/streamline/trace.hpp>

#include <vector>

namespace elvis {

/**
 * Of each point of the line a direction of length 1 across it, in which the ribbon lies. At the seed it lies across the z
 * axis, or across the x axis where the line goes along z. `flow`: along which the line was traced, with its spin, which is
 * where `TracePoint::turn` comes from.
 */
std::vector<Vector3> ribbon_sides(const Flow& flow, const Streamline& line);

} // namespace elvis
