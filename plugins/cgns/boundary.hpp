/**
 * @file boundary.hpp
 * Which faces belong to which boundary condition of a zone, or to a section of boundary elements.
 */
#pragma once

#include "sections.hpp"

#include <array>
#include <optional>

namespace elvis_cgns {

/** Corners of a face in ascending order, counted from 0 in the zone; the last ones are `no_corner` if it has fewer than 4. */
using FaceKey = std::array<std::uint32_t, 4>;
inline constexpr std::uint32_t no_corner = ~std::uint32_t{0};

FaceKey face_key(std::span<const std::uint32_t> corners);

struct FaceKeyHash {
    std::size_t operator()(const FaceKey& key) const;
};

/** Elements of a section on the boundary. */
struct BoundarySection {
    std::string name;
    std::uint64_t first = 0;
    std::vector<FaceKey> faces;
};

/** Groups of a zone, by name: its faces, and the vertices such that what lies between them belongs to it, too. */
struct BoundaryGroup {
    std::string name;
    std::vector<FaceKey> faces;
    std::vector<std::uint32_t> vertices;
};

/** Boundary conditions of a zone, and sections of which no boundary condition names an element. */
std::vector<BoundaryGroup> read_boundary(Tree& tree, const Zone& zone, const std::vector<BoundarySection>& sections,
                                         const elvis::api::Host& host);

} // namespace elvis_cgns
