#include "node_order.hpp"

namespace elvis_vtk {

namespace {

LatticePoint operator+(const LatticePoint& a, const LatticePoint& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
LatticePoint operator*(int factor, const LatticePoint& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }
/** (b - a) / n for corners whose difference is a multiple of n: one step along an edge. */
LatticePoint step(const LatticePoint& a, const LatticePoint& b, int n) {
    return {(b[0] - a[0]) / n, (b[1] - a[1]) / n, (b[2] - a[2]) / n};
}

/** Nodes strictly between two corners, from the first to the second. */
void add_edge(std::vector<LatticePoint>& nodes, const LatticePoint& from, const LatticePoint& to, int n) {
    for (int i = 1; i < n; ++i) {
        nodes.push_back(from + i * step(from, to, n));
    }
}

/** Nodes inside the parallelogram at `origin` with sides n steps of u and m steps of v; u runs fastest. */
void add_grid(std::vector<LatticePoint>& nodes, const LatticePoint& origin, const LatticePoint& u, int n, const LatticePoint& v,
              int m) {
    for (int j = 1; j < m; ++j) {
        for (int i = 1; i < n; ++i) {
            nodes.push_back(origin + i * u + j * v);
        }
    }
}

/** All nodes of the triangle with corner a and n steps of u and v: corners, edges ab, bc, ca, then the triangle inside. */
void add_triangle(std::vector<LatticePoint>& nodes, LatticePoint a, const LatticePoint& u, const LatticePoint& v, int n) {
    for (; n >= 0; n -= 3, a = a + u + v) {
        if (n == 0) {
            nodes.push_back(a);
            return;
        }
        const LatticePoint b = a + n * u, c = a + n * v;
        nodes.insert(nodes.end(), {a, b, c});
        add_edge(nodes, a, b, n);
        add_edge(nodes, b, c, n);
        add_edge(nodes, c, a, n);
    }
}

/** The nodes of a triangular face that are on none of its edges: those of the triangle inside. */
void add_triangle_interior(std::vector<LatticePoint>& nodes, const LatticePoint& a, const LatticePoint& b,
                           const LatticePoint& c, int n) {
    const LatticePoint u = step(a, b, n), v = step(a, c, n);
    add_triangle(nodes, a + u + v, u, v, n - 3);
}

} // namespace

std::vector<LatticePoint> triangle_nodes(int degree) {
    std::vector<LatticePoint> nodes;
    add_triangle(nodes, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, degree);
    return nodes;
}

std::vector<LatticePoint> quadrilateral_nodes(int degree_r, int degree_s) {
    const int p = degree_r, q = degree_s;
    std::vector<LatticePoint> nodes{{0, 0, 0}, {p, 0, 0}, {p, q, 0}, {0, q, 0}};
    add_edge(nodes, {0, 0, 0}, {p, 0, 0}, p);
    add_edge(nodes, {p, 0, 0}, {p, q, 0}, q);
    add_edge(nodes, {0, q, 0}, {p, q, 0}, p);
    add_edge(nodes, {0, 0, 0}, {0, q, 0}, q);
    add_grid(nodes, {0, 0, 0}, {1, 0, 0}, p, {0, 1, 0}, q);
    return nodes;
}

std::vector<LatticePoint> tetrahedron_nodes(int degree) {
    std::vector<LatticePoint> nodes;
    LatticePoint a{0, 0, 0};
    for (int n = degree; n >= 0; n -= 4, a = a + LatticePoint{1, 1, 1}) {
        if (n == 0) {
            nodes.push_back(a);
            break;
        }
        const LatticePoint b = a + LatticePoint{n, 0, 0}, c = a + LatticePoint{0, n, 0}, d = a + LatticePoint{0, 0, n};
        nodes.insert(nodes.end(), {a, b, c, d});
        add_edge(nodes, a, b, n);
        add_edge(nodes, b, c, n);
        add_edge(nodes, c, a, n);
        add_edge(nodes, a, d, n);
        add_edge(nodes, b, d, n);
        add_edge(nodes, c, d, n);
        add_triangle_interior(nodes, a, b, d, n);
        add_triangle_interior(nodes, c, d, b, n);
        add_triangle_interior(nodes, a, d, c, n);
        add_triangle_interior(nodes, a, c, b, n);
    }
    return nodes;
}

std::vector<LatticePoint> hexahedron_nodes(int degree_r, int degree_s, int degree_t) {
    const int p = degree_r, q = degree_s, m = degree_t;
    std::vector<LatticePoint> nodes{{0, 0, 0}, {p, 0, 0}, {p, q, 0}, {0, q, 0}, {0, 0, m}, {p, 0, m}, {p, q, m}, {0, q, m}};
    for (const int k : {0, m}) {
        add_edge(nodes, {0, 0, k}, {p, 0, k}, p);
        add_edge(nodes, {p, 0, k}, {p, q, k}, q);
        add_edge(nodes, {0, q, k}, {p, q, k}, p);
        add_edge(nodes, {0, 0, k}, {0, q, k}, q);
    }
    add_edge(nodes, {0, 0, 0}, {0, 0, m}, m);
    add_edge(nodes, {p, 0, 0}, {p, 0, m}, m);
    add_edge(nodes, {p, q, 0}, {p, q, m}, m);
    add_edge(nodes, {0, q, 0}, {0, q, m}, m);
    for (const int i : {0, p}) {
        add_grid(nodes, {i, 0, 0}, {0, 1, 0}, q, {0, 0, 1}, m);
    }
    for (const int j : {0, q}) {
        add_grid(nodes, {0, j, 0}, {1, 0, 0}, p, {0, 0, 1}, m);
    }
    for (const int k : {0, m}) {
        add_grid(nodes, {0, 0, k}, {1, 0, 0}, p, {0, 1, 0}, q);
    }
    for (int k = 1; k < m; ++k) {
        add_grid(nodes, {0, 0, k}, {1, 0, 0}, p, {0, 1, 0}, q);
    }
    return nodes;
}

std::vector<LatticePoint> wedge_nodes(int degree, int degree_t) {
    const int n = degree, m = degree_t;
    std::vector<LatticePoint> nodes{{0, 0, 0}, {n, 0, 0}, {0, n, 0}, {0, 0, m}, {n, 0, m}, {0, n, m}};
    for (const int k : {0, m}) {
        add_edge(nodes, {0, 0, k}, {n, 0, k}, n);
        add_edge(nodes, {n, 0, k}, {0, n, k}, n);
        add_edge(nodes, {0, n, k}, {0, 0, k}, n);
    }
    add_edge(nodes, {0, 0, 0}, {0, 0, m}, m);
    add_edge(nodes, {n, 0, 0}, {n, 0, m}, m);
    add_edge(nodes, {0, n, 0}, {0, n, m}, m);
    // Inside triangles the nodes lie in rows, not in nested triangles as in the triangle and the tetrahedron.
    const auto add_rows = [&](int k) {
        for (int j = 1; j < n; ++j) {
            for (int i = 1; i < n - j; ++i) {
                nodes.push_back({i, j, k});
            }
        }
    };
    add_rows(0);
    add_rows(m);
    add_grid(nodes, {0, 0, 0}, {1, 0, 0}, n, {0, 0, 1}, m);
    add_grid(nodes, {n, 0, 0}, {-1, 1, 0}, n, {0, 0, 1}, m);
    add_grid(nodes, {0, n, 0}, {0, -1, 0}, n, {0, 0, 1}, m);
    for (int k = 1; k < m; ++k) {
        add_rows(k);
    }
    return nodes;
}

std::vector<LatticePoint> lattice_nodes(const CellKind& kind) {
    const auto [p, q, r] = kind.degree;
    switch (kind.family) {
    case Family::tensor:
        return kind.shape == ELVIS_SHAPE_QUADRILATERAL ? quadrilateral_nodes(p, q) : hexahedron_nodes(p, q, r);
    case Family::simplex:
        return kind.shape == ELVIS_SHAPE_TRIANGLE ? triangle_nodes(p) : tetrahedron_nodes(p);
    case Family::wedge:
        return wedge_nodes(p, r);
    default:
        return {};
    }
}

} // namespace elvis_vtk
