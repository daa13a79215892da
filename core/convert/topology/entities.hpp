/**
 * @file entities.hpp
 * Projection onto a continuous space: corners, then edges, faces and interior, each from data on that entity alone.
 *
 * Neighbours see the same data at the same points of what they share, and so find the same function there without talking
 * (L. Demkowicz's projection-based interpolation, with the L2 norm on each entity). It needs the modified basis, whose modes
 * vanish on the entities before their own. The orders on both sides of a face must agree; where they do not, the field jumps.
 */
#pragma once

#include <core/convert/projection/projector.hpp>

namespace elvis {

PointProjection entity_projection(const native::Space& space);

} // namespace elvis
