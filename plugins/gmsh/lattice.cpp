#include "lattice.hpp"

#include <span>

namespace gmsh {

namespace {

using enum Topology;
using Nodes = std::vector<LatticeIndex>;

/** Corners in units of the order, edges and faces by corners. A triangle's fourth corner is -1. */
struct Template {
    std::vector<LatticeIndex> corners;
    std::vector<std::array<int, 2>> edges;
    std::vector<std::array<int, 4>> faces;
};

const Template& template_of(Topology topology) {
    static const Template of_triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1}, {1, 2}, {2, 0}}, {{0, 1, 2, -1}}};
    static const Template of_quadrilateral{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {{0, 1, 2, 3}}};
    static const Template of_tetrahedron{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                         {{0, 1}, {1, 2}, {2, 0}, {3, 0}, {3, 2}, {3, 1}},
                                         {{0, 2, 1, -1}, {0, 1, 3, -1}, {0, 3, 2, -1}, {3, 1, 2, -1}}};
    static const Template of_pyramid{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}},
                                     {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}},
                                     {{0, 1, 4, -1}, {3, 0, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {0, 3, 2, 1}}};
    static const Template of_prism{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
                                   {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4}, {2, 5}, {3, 4}, {3, 5}, {4, 5}},
                                   {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {0, 3, 5, 2}, {1, 2, 5, 4}}};
    static const Template of_hexahedron{
        {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
        {{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3}, {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}},
        {{0, 3, 2, 1}, {0, 1, 5, 4}, {0, 4, 7, 3}, {1, 2, 6, 5}, {2, 3, 7, 6}, {4, 5, 6, 7}}};
    switch (topology) {
    case triangle:
        return of_triangle;
    case quadrilateral:
        return of_quadrilateral;
    case tetrahedron:
        return of_tetrahedron;
    case pyramid:
        return of_pyramid;
    case prism:
        return of_prism;
    default:
        return of_hexahedron;
    }
}

Nodes complete(Topology topology, int n);

/** Appends the nodes of a smaller element, moved by one step along each axis that it has. */
void append_inner(Nodes& nodes, Topology topology, int n) {
    const int third = dimension(topology) == 3 ? 1 : 0;
    for (const LatticeIndex& inner : complete(topology, n)) {
        nodes.push_back({inner[0] + 1, inner[1] + 1, inner[2] + third});
    }
}

/** Nodes strictly inside a face: those of a smaller one, along the axes from its first corner to its second and its last. */
void append_face(Nodes& nodes, const Template& shape, const std::array<int, 4>& face, int n) {
    const bool is_triangle = face[3] < 0;
    const int inner_order = n - (is_triangle ? 3 : 2);
    if (inner_order < 0) {
        return;
    }
    const auto corner = [&](int which) {
        return shape.corners[static_cast<std::size_t>(face[static_cast<std::size_t>(which)])];
    };
    const LatticeIndex origin = corner(0), first = corner(1), second = corner(is_triangle ? 2 : 3);
    for (const LatticeIndex& inner : complete(is_triangle ? triangle : quadrilateral, inner_order)) {
        LatticeIndex node{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node[axis] = n * origin[axis] + (inner[0] + 1) * (first[axis] - origin[axis]) +
                         (inner[1] + 1) * (second[axis] - origin[axis]);
        }
        nodes.push_back(node);
    }
}

/** Nodes strictly inside a prism: for each of a triangle of order n - 3, a line of order n - 2 (ends first). */
void append_prism_inside(Nodes& nodes, int n) {
    for (const LatticeIndex& in_triangle : complete(triangle, n - 3)) {
        const auto append = [&](int height) { nodes.push_back({in_triangle[0] + 1, in_triangle[1] + 1, height + 1}); };
        append(0);
        append(n - 2);
        for (int height = 1; height < n - 2; ++height) {
            append(height);
        }
    }
}

Nodes corners_and_edges(const Template& shape, int n) {
    Nodes nodes;
    for (const LatticeIndex& corner : shape.corners) {
        nodes.push_back({n * corner[0], n * corner[1], n * corner[2]});
    }
    for (const auto& edge : shape.edges) {
        const LatticeIndex& from = shape.corners[static_cast<std::size_t>(edge[0])];
        const LatticeIndex& to = shape.corners[static_cast<std::size_t>(edge[1])];
        for (int step = 1; step < n; ++step) {
            LatticeIndex node{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node[axis] = n * from[axis] + step * (to[axis] - from[axis]);
            }
            nodes.push_back(node);
        }
    }
    return nodes;
}

Nodes complete(Topology topology, int n) {
    if (n == 0) {
        return {{0, 0, 0}};
    }
    const Template& shape = template_of(topology);
    Nodes nodes = corners_and_edges(shape, n);
    for (const auto& face : shape.faces) {
        append_face(nodes, shape, face, n);
    }
    if (topology == tetrahedron && n >= 4) {
        append_inner(nodes, topology, n - 4);
    } else if (topology == hexahedron && n >= 2) {
        append_inner(nodes, topology, n - 2);
    } else if (topology == pyramid && n >= 3) {
        append_inner(nodes, topology, n - 3);
    } else if (topology == prism && n >= 3) {
        append_prism_inside(nodes, n);
    }
    return nodes;
}

} // namespace

std::vector<LatticeIndex> lattice(const ElementType& type) {
    return type.is_serendipity ? corners_and_edges(template_of(type.topology), type.order)
                               : complete(type.topology, type.order);
}

std::array<double, 3> lattice_point(Topology topology, int order, const LatticeIndex& index) {
    std::array<double, 3> unit{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        unit[axis] = static_cast<double>(index[axis]) / order;
    }
    switch (topology) {
    case triangle:
    case tetrahedron:
        return unit;
    case pyramid:
        return {2 * unit[0] - (1 - unit[2]), 2 * unit[1] - (1 - unit[2]), unit[2]};
    case prism:
        return {unit[0], unit[1], 2 * unit[2] - 1};
    case quadrilateral:
        return {2 * unit[0] - 1, 2 * unit[1] - 1, 0};
    default:
        return {2 * unit[0] - 1, 2 * unit[1] - 1, 2 * unit[2] - 1};
    }
}

} // namespace gmsh
