/**
 * @file nodes_text.hpp
 * GLSL that says where the nodes of a class's Lagrange bases are.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <span>
#include <string>

namespace nektarpp {

/**
 * Arrays nektar_nodes_p, _q, _r and nektar_scales_p, .. (1 / prod_{j != i} (node_i - node_j)) for each field's order, chosen by
 * NEKTAR_FIELD_NODES (0 Gauss-Lobatto-Legendre, 1 Gauss-Legendre) and NEKTAR_FIELD_P, _Q, _R. Empty without Lagrange bases.
 */
std::string write_nodes(std::span<const elvis::native::Space> fields);

} // namespace nektarpp
