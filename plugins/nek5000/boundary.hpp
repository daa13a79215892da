/**
 * @file boundary.hpp
 * Boundary groups: the conditions that a mesh file beside the fields has for its faces.
 */
#pragma once

#include "mesh_file.hpp"

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

} // namespace elvis_nek5000
