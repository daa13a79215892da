#include "nodes.hpp"

namespace elvis_cgns {

namespace {

using enum Topology;

Point blend(const Point& a, const Point& b, double at) {
    return {a[0] + at * (b[0] - a[0]), a[1] + at * (b[1] - a[1]), a[2] + at * (b[2] - a[2])};
}

void append_edge(std::vector<Point>& to, const Point& from, const Point& end, int order) {
    for (int step = 1; step < order; ++step) {
        to.push_back(blend(from, end, static_cast<double>(step) / order));
    }
}

/** Inside a triangle: the nodes of a smaller one, of order n - 3, in the same order; n is at most 4. */
void append_triangle(std::vector<Point>& to, const std::array<Point, 3>& corners, int n) {
    if (n == 3) {
        to.push_back(blend(blend(corners[0], corners[1], 1.0 / 2), corners[2], 1.0 / 3));
    } else if (n == 4) {
        for (std::size_t near = 0; near < 3; ++near) {
            const Point opposite = blend(corners[(near + 1) % 3], corners[(near + 2) % 3], 0.5);
            to.push_back(blend(corners[near], opposite, 0.5));
        }
    }
}

/** Inside a quadrilateral: once around from the node next to the first corner, then the one in the middle; n is at most 4. */
void append_quadrilateral(std::vector<Point>& to, const std::array<Point, 4>& corners, int n) {
    const auto append = [&](int i, int j) {
        const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
        to.push_back(blend(blend(corners[0], corners[1], x), blend(corners[3], corners[2], x), y));
    };
    const int last = n - 1;
    for (int step = 1; step < last; ++step) {
        append(step, 1);
    }
    for (int step = 1; step < last; ++step) {
        append(last, step);
    }
    for (int step = last; step > 1; --step) {
        append(step, last);
    }
    for (int step = last; step > 1; --step) {
        append(1, step);
    }
    if (n % 2 == 0) {
        append(n / 2, n / 2);
    }
}

void append_face(std::vector<Point>& to, const Parts& parts, const Face& face, int order) {
    const auto corner = [&](std::size_t which) { return parts.corners[static_cast<std::size_t>(face.corners[which])]; };
    if (face.n_corners == 3) {
        append_triangle(to, {corner(0), corner(1), corner(2)}, order);
    } else {
        append_quadrilateral(to, {corner(0), corner(1), corner(2), corner(3)}, order);
    }
}

/** Layer by layer, each as inside the lowest face. */
void append_layers(std::vector<Point>& to, const Parts& parts, int order) {
    const std::size_t n = parts.corners.size() / 2;
    for (int layer = 1; layer < order; ++layer) {
        std::array<Point, 4> corners{};
        for (std::size_t corner = 0; corner < n; ++corner) {
            corners[corner] = blend(parts.corners[corner], parts.corners[n + corner], static_cast<double>(layer) / order);
        }
        if (n == 3) {
            append_triangle(to, {corners[0], corners[1], corners[2]}, order);
        } else {
            append_quadrilateral(to, corners, order);
        }
    }
}

void append_inside(std::vector<Point>& to, Topology topology, int order) {
    if (topology == tetrahedron && order == 4) {
        to.push_back({0.25, 0.25, 0.25});
    } else if (topology == pyramid && order == 3) {
        to.push_back({0, 0, 1.0 / 3});
    } else if (topology == pyramid && order == 4) {
        // A smaller pyramid, one step above the base.
        for (const Point& corner : parts(pyramid).corners) {
            to.push_back({corner[0] / 4, corner[1] / 4, (corner[2] + 1) / 4});
        }
    } else if (topology == prism || topology == hexahedron) {
        append_layers(to, parts(topology), order);
    }
}

} // namespace

const Parts& parts(Topology topology) {
    static const std::array<Parts, 8> all{{
        {{{0, 0, 0}}, {}, {}},
        {{{-1, 0, 0}, {1, 0, 0}}, {{0, 1}}, {}},
        {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1}, {1, 2}, {2, 0}}, {{3, {0, 1, 2, 0}}}},
        {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {{4, {0, 1, 2, 3}}}},
        {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
         {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
         {{3, {0, 1, 2, 0}}, {3, {0, 1, 3, 0}}, {3, {1, 2, 3, 0}}, {3, {2, 0, 3, 0}}}},
        {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}},
         {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
         {{4, {0, 1, 2, 3}}, {3, {0, 1, 4, 0}}, {3, {1, 2, 4, 0}}, {3, {2, 3, 4, 0}}, {3, {3, 0, 4, 0}}}},
        {{{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
         {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}},
         {{3, {0, 1, 2, 0}}, {4, {0, 1, 4, 3}}, {4, {1, 2, 5, 4}}, {4, {2, 0, 3, 5}}, {3, {3, 4, 5, 0}}}},
        {{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
         {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5}, {2, 6}, {3, 7}, {4, 5}, {5, 6}, {6, 7}, {7, 4}},
         {{4, {0, 1, 2, 3}}, {4, {0, 1, 5, 4}}, {4, {1, 2, 6, 5}}, {4, {2, 3, 7, 6}}, {4, {3, 0, 4, 7}}, {4, {4, 5, 6, 7}}}},
    }};
    return all[static_cast<std::size_t>(topology)];
}

std::size_t n_inner_nodes(Topology topology, int order) {
    std::vector<Point> inside;
    append_inside(inside, topology, order);
    return inside.size();
}

std::vector<Point> nodes(const ElementType& type) {
    const Parts& parts = elvis_cgns::parts(type.topology);
    std::vector<Point> all = parts.corners;
    for (const auto& edge : parts.edges) {
        append_edge(all, parts.corners[static_cast<std::size_t>(edge[0])], parts.corners[static_cast<std::size_t>(edge[1])],
                    type.order);
    }
    if (type.nodes != Nodes::of_edges) {
        for (const Face& face : parts.faces) {
            append_face(all, parts, face, type.order);
        }
    }
    if (type.nodes == Nodes::all) {
        append_inside(all, type.topology, type.order);
    }
    return all;
}

Point source_point(Topology topology, const double* xi) {
    const Point unit{(1 + xi[0]) / 2, (1 + xi[1]) / 2, (1 + xi[2]) / 2};
    switch (topology) {
    case triangle:
    case tetrahedron:
        return unit;
    case pyramid:
        return {2 * unit[0] - (1 - unit[2]), 2 * unit[1] - (1 - unit[2]), unit[2]};
    case prism:
        return {unit[2], unit[0], xi[1]};
    default:
        return {xi[0], xi[1], xi[2]};
    }
}

std::span<const int> source_corners(Topology topology) {
    static constexpr std::array in_order{0, 1, 2, 3, 4, 5, 6, 7};
    static constexpr std::array of_prism{0, 2, 5, 3, 1, 4};
    return topology == prism ? std::span<const int>(of_prism) : std::span<const int>(in_order).first(n_corners(topology));
}

} // namespace elvis_cgns
