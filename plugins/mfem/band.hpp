/**
 * @file band.hpp
 * Meshes of segments: curves, as bands.
 *
 * A curve has no area to be drawn. Each segment becomes a quadrilateral, along the coordinate in which the curve is thinnest,
 * and what is on the curve is constant across. The band is a twentieth as wide as the curve is large: integrals over it are
 * those along the curve times that width.
 */
#pragma once

#include "mesh.hpp"

#include <cstdint>
#include <vector>

namespace elvis_mfem {

/** The segments that a band is made of. */
struct Segments {
    std::size_t n_vertices = 0;
    /** Two vertices each. */
    std::vector<std::array<std::int32_t, 2>> vertices;
};

/**
 * Of a mesh whose elements are segments, by the first two of their vertices, and whose boundary are points. Throws
 * std::invalid_argument for nodes that do not fit.
 */
Mesh band_of(Mesh curve);

/** The same function on the band: by values or coefficients of its own in each quadrilateral. Throws likewise. */
GridFunction on_band(const GridFunction& function, const Segments& segments);

} // namespace elvis_mfem
