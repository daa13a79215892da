/**
 * @file all_boxes.hpp
 * Bounds of a volume's elements, which the members of a team read together.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/base/team.hpp>
#include <core/parts/partition.hpp>

#include <vector>

namespace elvis {

/** The parts that the team's members own: shares of them, in the order of ranks. */
inline Span own_parts(const Partition& partition, const Team& team) {
    return share(partition.n_parts(), team.size(), team.rank());
}

/** Six numbers an element, on all: each member reads those of the parts that it owns. Called by all. */
std::vector<double> all_boxes(const RuntimeVolume& whole, const Partition& partition, Team& team, const TaskControl* control);

} // namespace elvis
