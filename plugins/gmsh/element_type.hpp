/**
 * @file element_type.hpp
 * Element types of MSH files by their numbers.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace gmsh {

/** Numbers as in $InterpolationScheme. */
enum class Topology { point = 1, line, triangle, quadrilateral, tetrahedron, pyramid, prism, hexahedron };

struct ElementType {
    Topology topology = Topology::point;
    int order = 1;
    /** Nodes at corners and on edges only. */
    bool is_serendipity = false;

    friend auto operator<=>(const ElementType&, const ElementType&) = default;
};

/** Largest order of a type. */
constexpr int max_type_order = 10;

/** Type of a number, if it is one that this plugin reads. */
std::optional<ElementType> element_type(int number);

int dimension(Topology topology);
int n_corners(Topology topology);
std::size_t n_nodes(const ElementType& type);
std::string name(const ElementType& type);

/** Shape of an element of two or three dimensions. */
elvis::native::Shape shape(Topology topology);

} // namespace gmsh
