/**
 * @file hanging_faces.hpp
 * Faces that meet several smaller ones.
 */
#pragma once

#include <core/convert/topology/topology.hpp>

namespace elvis {

/**
 * Marks as unknown the neighbours of those faces without neighbour and boundary group that cover the centre of another such
 * face or are covered by one. What is left is the boundary.
 */
void mark_hanging_faces(const SourceVolume& source, const std::vector<FaceSide>& unpaired, Topology& topology,
                        const TaskControl& control);

} // namespace elvis
