#include <core/export/lagrange_nodes.hpp>

#include <core/base/vector3.hpp>

#include <cassert>

namespace elvis {

namespace {

/** a + x (b - a) + y (c - a) */
Vector3 blend(const Vector3& a, double x, const Vector3& b, double y, const Vector3& c) {
    return plus(plus(a, scaled(minus(b, a), x)), scaled(minus(c, a), y));
}

/** Collects nodes of a cell whose edges have n steps. */
class NodeList {
public:
    explicit NodeList(std::uint32_t order) : m_order(order) {}

    std::vector<double> take() { return std::move(m_nodes); }

    void add(const Vector3& point) { m_nodes.insert(m_nodes.end(), point.begin(), point.end()); }

    /** Inside the edge from a to b. */
    void add_edge(const Vector3& a, const Vector3& b) { add_edge(a, b, m_order); }

    /** Inside the parallelogram with corner a and sides ab, ac; fastest along ab. */
    void add_quadrilateral(const Vector3& a, const Vector3& b, const Vector3& c) {
        for (std::uint32_t j = 1; j < m_order; ++j) {
            for (std::uint32_t i = 1; i < m_order; ++i) {
                add(blend(a, fraction(i), b, fraction(j), c));
            }
        }
    }

    /** Inside the triangle, row by row along ab: the order of wedges. */
    void add_triangle_rows(const Vector3& a, const Vector3& b, const Vector3& c) {
        for (std::uint32_t j = 1; j < m_order; ++j) {
            for (std::uint32_t i = 1; i + j < m_order; ++i) {
                add(blend(a, fraction(i), b, fraction(j), c));
            }
        }
    }

    /** Inside a triangle whose edges have n steps, triangle within triangle: the order of tetrahedra. */
    void add_nested_triangle(const Vector3& a, const Vector3& b, const Vector3& c, std::uint32_t n) {
        if (n < 3) {
            return;
        }
        const double step = 1.0 / n;
        const Vector3 inner_a = blend(a, step, b, step, c), inner_b = blend(b, step, a, step, c),
                      inner_c = blend(c, step, a, step, b);
        add(inner_a);
        if (n == 3) {
            return;
        }
        add(inner_b);
        add(inner_c);
        add_edge(inner_a, inner_b, n - 3);
        add_edge(inner_b, inner_c, n - 3);
        add_edge(inner_c, inner_a, n - 3);
        add_nested_triangle(inner_a, inner_b, inner_c, n - 3);
    }

    /** All of a tetrahedron whose edges have n steps. */
    void add_tetrahedron(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d, std::uint32_t n) {
        add(a);
        if (n == 0) {
            return;
        }
        add(b);
        add(c);
        add(d);
        add_edge(a, b, n);
        add_edge(b, c, n);
        add_edge(c, a, n);
        add_edge(a, d, n);
        add_edge(b, d, n);
        add_edge(c, d, n);
        add_nested_triangle(a, b, d, n);
        add_nested_triangle(c, d, b, n);
        add_nested_triangle(a, d, c, n);
        add_nested_triangle(a, c, b, n);
        if (n >= 4) {
            const double step = 1.0 / n;
            const auto toward = [&](const Vector3& corner, const Vector3& x, const Vector3& y, const Vector3& z) {
                Vector3 point = corner;
                for (std::size_t i = 0; i < 3; ++i) {
                    point[i] += step * (x[i] + y[i] + z[i] - 3 * corner[i]);
                }
                return point;
            };
            add_tetrahedron(toward(a, b, c, d), toward(b, a, c, d), toward(c, a, b, d), toward(d, a, b, c), n - 4);
        }
    }

private:
    void add_edge(const Vector3& a, const Vector3& b, std::uint32_t n) {
        for (std::uint32_t i = 1; i < n; ++i) {
            add(blend(a, static_cast<double>(i) / n, b, 0, a));
        }
    }
    double fraction(std::uint32_t i) const { return static_cast<double>(i) / m_order; }

    std::uint32_t m_order;
    std::vector<double> m_nodes;
};

std::vector<double> hexahedron_nodes(std::uint32_t order) {
    const auto at = [](double x, double y, double z) { return Vector3{x, y, z}; };
    NodeList nodes(order);
    for (const double z : {-1.0, 1.0}) {
        for (const Vector3& corner : {at(-1, -1, z), at(1, -1, z), at(1, 1, z), at(-1, 1, z)}) {
            nodes.add(corner);
        }
    }
    for (const double z : {-1.0, 1.0}) {
        nodes.add_edge(at(-1, -1, z), at(1, -1, z));
        nodes.add_edge(at(1, -1, z), at(1, 1, z));
        nodes.add_edge(at(-1, 1, z), at(1, 1, z));
        nodes.add_edge(at(-1, -1, z), at(-1, 1, z));
    }
    nodes.add_edge(at(-1, -1, -1), at(-1, -1, 1));
    nodes.add_edge(at(1, -1, -1), at(1, -1, 1));
    nodes.add_edge(at(1, 1, -1), at(1, 1, 1));
    nodes.add_edge(at(-1, 1, -1), at(-1, 1, 1));
    for (const double x : {-1.0, 1.0}) {
        nodes.add_quadrilateral(at(x, -1, -1), at(x, 1, -1), at(x, -1, 1));
    }
    for (const double y : {-1.0, 1.0}) {
        nodes.add_quadrilateral(at(-1, y, -1), at(1, y, -1), at(-1, y, 1));
    }
    for (const double z : {-1.0, 1.0}) {
        nodes.add_quadrilateral(at(-1, -1, z), at(1, -1, z), at(-1, 1, z));
    }
    for (std::uint32_t k = 1; k < order; ++k) {
        const double z = 2.0 * k / order - 1;
        nodes.add_quadrilateral(at(-1, -1, z), at(1, -1, z), at(-1, 1, z));
    }
    return nodes.take();
}

std::vector<double> wedge_nodes(std::uint32_t order) {
    // Triangle (a, b, c) of VTK at the height xi2: xi3 runs from a to b and xi1 from a to c, which keeps the orientation.
    const auto a = [](double y) { return Vector3{-1, y, -1}; };
    const auto b = [](double y) { return Vector3{-1, y, 1}; };
    const auto c = [](double y) { return Vector3{1, y, -1}; };
    NodeList nodes(order);
    for (const double y : {-1.0, 1.0}) {
        nodes.add(a(y));
        nodes.add(b(y));
        nodes.add(c(y));
    }
    for (const double y : {-1.0, 1.0}) {
        nodes.add_edge(a(y), b(y));
        nodes.add_edge(b(y), c(y));
        nodes.add_edge(c(y), a(y));
    }
    nodes.add_edge(a(-1), a(1));
    nodes.add_edge(b(-1), b(1));
    nodes.add_edge(c(-1), c(1));
    for (const double y : {-1.0, 1.0}) {
        nodes.add_triangle_rows(a(y), b(y), c(y));
    }
    nodes.add_quadrilateral(a(-1), b(-1), a(1));
    nodes.add_quadrilateral(b(-1), c(-1), b(1));
    nodes.add_quadrilateral(c(-1), a(-1), c(1));
    for (std::uint32_t k = 1; k < order; ++k) {
        const double y = 2.0 * k / order - 1;
        nodes.add_triangle_rows(a(y), b(y), c(y));
    }
    return nodes.take();
}

std::vector<double> triangle_nodes(std::uint32_t order) {
    const Vector3 a{-1, -1, 0}, b{1, -1, 0}, c{-1, 1, 0};
    NodeList nodes(order);
    for (const Vector3& corner : {a, b, c}) {
        nodes.add(corner);
    }
    nodes.add_edge(a, b);
    nodes.add_edge(b, c);
    nodes.add_edge(c, a);
    nodes.add_nested_triangle(a, b, c, order);
    return nodes.take();
}

std::vector<double> quadrilateral_nodes(std::uint32_t order) {
    const Vector3 a{-1, -1, 0}, b{1, -1, 0}, c{1, 1, 0}, d{-1, 1, 0};
    NodeList nodes(order);
    for (const Vector3& corner : {a, b, c, d}) {
        nodes.add(corner);
    }
    nodes.add_edge(a, b);
    nodes.add_edge(b, c);
    nodes.add_edge(d, c);
    nodes.add_edge(a, d);
    nodes.add_quadrilateral(a, b, d);
    return nodes.take();
}

} // namespace

std::uint8_t vtk_cell_type(elvis_shape shape) {
    switch (shape) {
    case ELVIS_SHAPE_TETRAHEDRON:
        return 71;
    case ELVIS_SHAPE_HEXAHEDRON:
        return 72;
    case ELVIS_SHAPE_PRISM:
        return 73;
    case ELVIS_SHAPE_TRIANGLE:
        return 69;
    case ELVIS_SHAPE_QUADRILATERAL:
        return 70;
    default:
        return 14;
    }
}

std::vector<double> lagrange_nodes(elvis_shape shape, std::uint32_t order) {
    switch (shape) {
    case ELVIS_SHAPE_TETRAHEDRON: {
        NodeList nodes(order);
        nodes.add_tetrahedron({-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, order);
        return nodes.take();
    }
    case ELVIS_SHAPE_HEXAHEDRON:
        return hexahedron_nodes(order);
    case ELVIS_SHAPE_PRISM:
        return wedge_nodes(order);
    case ELVIS_SHAPE_TRIANGLE:
        return triangle_nodes(order);
    case ELVIS_SHAPE_QUADRILATERAL:
        return quadrilateral_nodes(order);
    default:
        assert(shape == ELVIS_SHAPE_PYRAMID && order == 1);
        return {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1, -1, -1, 1};
    }
}

} // namespace elvis
