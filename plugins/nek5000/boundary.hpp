/**
 * @file boundary.hpp
 * Boundary groups: the conditions that a mesh file beside the fields has for its faces.
 */
#pragma once

#include "mesh_file.hpp"

#include <elvis/plugin.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis_nek5000 {

class Boundary {
public:
    /** None. */
    Boundary() = default;
    /** Of all elements of the mesh; throws elvis::api::Error. */
    explicit Boundary(const MeshFile& mesh);

    /** W, v, O, SYM, ...; W 1, W 2, ... if the mesh tells surfaces of the same condition apart. */
    const std::vector<std::string>& names() const { return m_names; }
    /** Group of an element's face, both numbered as in ElVis; -1 if there is none. */
    std::int32_t group(std::uint64_t element, int local_face) const;

private:
    std::vector<std::string> m_names;
    std::vector<std::array<std::int16_t, 6>> m_groups;
};

/**
 * The groups of the first of these meshes that is there and has as many elements. The host is told of one that is not used,
 * which is no reason to refuse the fields: it was found by its name alone.
 */
Boundary find_boundary(const std::vector<std::string>& mesh_paths, std::uint64_t n_elements, std::uint32_t dimension,
                       const elvis::api::Host& host);

} // namespace elvis_nek5000
