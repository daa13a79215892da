/**
 * @file boundary_groups.hpp
 * Boundary attributes of a mesh as named groups of faces.
 */
#pragma once

#include "mesh.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

namespace elvis_mfem {

class BoundaryGroups {
public:
    explicit BoundaryGroups(const Mesh& mesh);

    /** Named after the attribute's set, or "attribute N". */
    const std::vector<std::string>& names() const { return m_names; }
    /** The group of a face of the ElVis shape, or ELVIS_GROUP_NONE. */
    std::int32_t of_face(const MeshElement& element, int local_face) const;

private:
    using Key = std::array<std::int32_t, 4>;
    struct KeyHash {
        std::size_t operator()(const Key& key) const;
    };
    std::vector<std::string> m_names;
    /** By sorted vertices. */
    std::unordered_map<Key, std::int32_t, KeyHash> m_groups;
};

} // namespace elvis_mfem
