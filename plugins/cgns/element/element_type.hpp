/**
 * @file element_type.hpp
 * The types of elements that sections of CGNS files hold: ElementType_t of the SIDS, by its number in files.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <cstddef>
#include <cstdint>
#include <string>

namespace elvis_cgns {

enum class Topology : std::uint8_t { node, line, triangle, quadrilateral, tetrahedron, pyramid, prism, hexahedron };

/** Which nodes an element has beside its corners. Where there is none inside a face, it has none inside the volume. */
enum class Nodes : std::uint8_t { of_edges, of_faces, all };

struct ElementType {
    Topology topology = Topology::node;
    int order = 1;
    Nodes nodes = Nodes::all;

    friend auto operator<=>(const ElementType&,
                            const ElementType&) = default; // NOLINT(modernize-use-nullptr): clang-tidy's own 0
};

/** Numbers that do not stand for one kind of element. */
inline constexpr std::int64_t mixed_number = 20, ngon_number = 22, nface_number = 23, last_number = 56;

/** The type; throws std::invalid_argument that says what the number stands for if it is none of one kind of element. */
const ElementType& element_type(std::int64_t number);

/** As in the SIDS: HEXA_27. */
std::string type_name(std::int64_t number);

int dimension(Topology topology);
std::size_t n_corners(Topology topology);
std::size_t n_nodes(const ElementType& type);
/** Of two or three dimensions. */
elvis::native::Shape shape(Topology topology);

} // namespace elvis_cgns
