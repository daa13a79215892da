/**
 * @file boundary_groups.hpp
 * Boundary attributes of a mesh as named groups of faces.
 */
#pragma once

#include "mesh.hpp"
#include "vertex_key.hpp"

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace elvis_mfem {

class BoundaryGroups {
public:
    /** `is_left_out`: of each boundary element, whether it is none. */
    BoundaryGroups(const Mesh& mesh, const std::vector<bool>& is_left_out);

    /** Named after the attribute's set, or "attribute N". */
    const std::vector<std::string>& names() const { return m_names; }
    /** Of each, the smallest of its attributes. */
    const std::vector<int>& attributes() const { return m_attributes; }
    /** The group of a face of the ElVis shape, or ELVIS_GROUP_NONE. */
    std::int32_t of_face(const MeshElement& element, int local_face) const;

private:
    std::vector<std::string> m_names;
    std::vector<int> m_attributes;
    /** By sorted vertices. */
    std::unordered_map<VertexKey, std::int32_t, VertexKeyHash> m_groups;
};

} // namespace elvis_mfem
