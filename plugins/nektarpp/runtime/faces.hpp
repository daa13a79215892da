/**
 * @file faces.hpp
 * Faces of the domain (edges in two dimensions), found by the ids that elements share.
 */
#pragma once

#include "../reader/geometry/mesh.hpp"

#include <elvis/plugin.hpp>

#include <vector>

namespace nektarpp {

/** Elements counted as in the mesh. Throws elvis::api::Error if more than two elements share a face. */
std::vector<elvis_face> find_faces(const Mesh& mesh);

} // namespace nektarpp
