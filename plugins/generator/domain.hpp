/**
 * @file domain.hpp
 * The exact shape of a mesh: a map from lattice points to world coordinates, orientation preserving.
 */
#pragma once

#include "mesh.hpp"

namespace generator {

class Domain {
public:
    explicit Domain(const Parameters& parameters) : m_parameters(parameters) {}

    Vec3 position(const LatticePoint& point) const;

    /** Whether the map is affine on every cell, so that it needs no interpolation. */
    bool is_affine() const { return m_parameters.mesh == MeshKind::box; }

private:
    Parameters m_parameters;
};

} // namespace generator
