#include "element_type.hpp"

#include "nodes.hpp"

#include <array>
#include <stdexcept>

namespace elvis_cgns {

namespace {

struct Named {
    const char* name;
    ElementType type;
};

using enum Topology;
using enum Nodes;

/** By number. Entries of order 0 are no elements of one kind. */
constexpr std::array<Named, last_number + 1> types{{
    {"ElementTypeNull", {node, 0, all}},
    {"ElementTypeUserDefined", {node, 0, all}},
    {"NODE", {node, 1, all}},
    {"BAR_2", {line, 1, all}},
    {"BAR_3", {line, 2, all}},
    {"TRI_3", {triangle, 1, all}},
    {"TRI_6", {triangle, 2, all}},
    {"QUAD_4", {quadrilateral, 1, all}},
    {"QUAD_8", {quadrilateral, 2, of_edges}},
    {"QUAD_9", {quadrilateral, 2, all}},
    {"TETRA_4", {tetrahedron, 1, all}},
    {"TETRA_10", {tetrahedron, 2, all}},
    {"PYRA_5", {pyramid, 1, all}},
    {"PYRA_14", {pyramid, 2, all}},
    {"PENTA_6", {prism, 1, all}},
    {"PENTA_15", {prism, 2, of_edges}},
    {"PENTA_18", {prism, 2, all}},
    {"HEXA_8", {hexahedron, 1, all}},
    {"HEXA_20", {hexahedron, 2, of_edges}},
    {"HEXA_27", {hexahedron, 2, all}},
    {"MIXED", {node, 0, all}},
    {"PYRA_13", {pyramid, 2, of_edges}},
    {"NGON_n", {node, 0, all}},
    {"NFACE_n", {node, 0, all}},
    {"BAR_4", {line, 3, all}},
    {"TRI_9", {triangle, 3, of_edges}},
    {"TRI_10", {triangle, 3, all}},
    {"QUAD_12", {quadrilateral, 3, of_edges}},
    {"QUAD_16", {quadrilateral, 3, all}},
    {"TETRA_16", {tetrahedron, 3, of_edges}},
    {"TETRA_20", {tetrahedron, 3, all}},
    {"PYRA_21", {pyramid, 3, of_edges}},
    {"PYRA_29", {pyramid, 3, of_faces}},
    {"PYRA_30", {pyramid, 3, all}},
    {"PENTA_24", {prism, 3, of_edges}},
    {"PENTA_38", {prism, 3, of_faces}},
    {"PENTA_40", {prism, 3, all}},
    {"HEXA_32", {hexahedron, 3, of_edges}},
    {"HEXA_56", {hexahedron, 3, of_faces}},
    {"HEXA_64", {hexahedron, 3, all}},
    {"BAR_5", {line, 4, all}},
    {"TRI_12", {triangle, 4, of_edges}},
    {"TRI_15", {triangle, 4, all}},
    {"QUAD_P4_16", {quadrilateral, 4, of_edges}},
    {"QUAD_25", {quadrilateral, 4, all}},
    {"TETRA_22", {tetrahedron, 4, of_edges}},
    {"TETRA_34", {tetrahedron, 4, of_faces}},
    {"TETRA_35", {tetrahedron, 4, all}},
    {"PYRA_P4_29", {pyramid, 4, of_edges}},
    {"PYRA_50", {pyramid, 4, of_faces}},
    {"PYRA_55", {pyramid, 4, all}},
    {"PENTA_33", {prism, 4, of_edges}},
    {"PENTA_66", {prism, 4, of_faces}},
    {"PENTA_75", {prism, 4, all}},
    {"HEXA_44", {hexahedron, 4, of_edges}},
    {"HEXA_98", {hexahedron, 4, of_faces}},
    {"HEXA_125", {hexahedron, 4, all}},
}};

} // namespace

const ElementType& element_type(std::int64_t number) {
    if (number < 0 || number > last_number) {
        throw std::invalid_argument("element type " + std::to_string(number) + " is none of the SIDS");
    }
    const Named& found = types[static_cast<std::size_t>(number)];
    if (number == ngon_number || number == nface_number) {
        throw std::invalid_argument(std::string(found.name) + ": polygons and polyhedra are not read");
    }
    if (found.type.order == 0) {
        throw std::invalid_argument("elements of type " + std::string(found.name) + " cannot be read");
    }
    return found.type;
}

std::string type_name(std::int64_t number) {
    return number >= 0 && number <= last_number ? types[static_cast<std::size_t>(number)].name
                                                : "element type " + std::to_string(number);
}

int dimension(Topology topology) {
    switch (topology) {
    case node:
        return 0;
    case line:
        return 1;
    case triangle:
    case quadrilateral:
        return 2;
    default:
        return 3;
    }
}

std::size_t n_corners(Topology topology) { return parts(topology).corners.size(); }

std::size_t n_nodes(const ElementType& type) {
    const Parts& parts = elvis_cgns::parts(type.topology);
    const auto n = static_cast<std::size_t>(type.order);
    std::size_t count = parts.corners.size() + parts.edges.size() * (n - 1);
    if (type.nodes != of_edges) {
        for (const Face& face : parts.faces) {
            count += face.n_corners == 3 ? (n - 1) * (n - 2) / 2 : (n - 1) * (n - 1);
        }
    }
    return type.nodes == all ? count + n_inner_nodes(type.topology, type.order) : count;
}

elvis::native::Shape shape(Topology topology) {
    using elvis::native::Shape;
    switch (topology) {
    case triangle:
        return Shape::triangle;
    case quadrilateral:
        return Shape::quadrilateral;
    case tetrahedron:
        return Shape::tetrahedron;
    case pyramid:
        return Shape::pyramid;
    case prism:
        return Shape::prism;
    default:
        return Shape::hexahedron;
    }
}

} // namespace elvis_cgns
