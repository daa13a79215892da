#include "functions.hpp"

#include <algorithm>
#include <cmath>

namespace elvis_cgns {

namespace {

using enum Topology;

/**
 * Factors of a function are taken from what vanishes where it must: a function of an edge on all other edges, one of a face on
 * all other faces. B. Szabo, I. Babuska, "Finite Element Analysis" (1991), section 6.1 and 13.1, has the same construction.
 */
class Values {
public:
    Values(const ElementType& type, const Point& x) : m_type(type), m_parts(parts(type.topology)), m_x(x) {}

    std::vector<double> all() {
        for (std::size_t corner = 0; corner < m_parts.corners.size(); ++corner) {
            m_values.push_back(of_corner(corner));
        }
        for (const auto& edge : m_parts.edges) {
            append_edge(static_cast<std::size_t>(edge[0]), static_cast<std::size_t>(edge[1]));
        }
        if (m_type.nodes != Nodes::of_edges) {
            for (const Face& face : m_parts.faces) {
                append_face(face);
            }
        }
        if (m_type.nodes == Nodes::all) {
            append_inside();
        }
        return std::move(m_values);
    }

private:
    bool is_tensor() const { return m_type.topology == quadrilateral || m_type.topology == hexahedron; }
    std::size_t n_axes() const { return static_cast<std::size_t>(dimension(m_type.topology)); }

    /** Barycentric coordinate of a corner of a triangle or tetrahedron, or of a prism's triangle. */
    double barycentric(std::size_t corner) const {
        if (m_type.topology == prism) {
            corner %= 3;
        }
        const double first = 1 - m_x[0] - m_x[1] - (m_type.topology == tetrahedron ? m_x[2] : 0);
        return corner == 0 ? first : m_x[corner - 1];
    }

    /** Linear along an axis: 1 at the side of the corner, 0 at the other. */
    double side(std::size_t corner, std::size_t axis) const { return (1 + m_parts.corners[corner][axis] * m_x[axis]) / 2; }
    /** Vanishes at both sides. */
    static double bubble(double x) { return 1 - x * x; }

    // Pyramids: x and y over the width of the section, which is of no consequence at the apex.
    double width() const { return 1 - m_x[2]; }
    double ratio(std::size_t axis) const { return width() != 0 ? m_x[axis] / width() : 0; }
    double ratio_side(std::size_t corner, std::size_t axis) const {
        return (1 + m_parts.corners[corner][axis] * ratio(axis)) / 2;
    }

    double of_corner(std::size_t corner) const {
        if (is_tensor()) {
            double value = 1;
            for (std::size_t axis = 0; axis < n_axes(); ++axis) {
                value *= side(corner, axis);
            }
            return value;
        }
        if (m_type.topology == pyramid) {
            return corner == 4 ? m_x[2] : ratio_side(corner, 0) * ratio_side(corner, 1) * width();
        }
        return m_type.topology == prism ? barycentric(corner) * side(corner, 2) : barycentric(corner);
    }

    /** The axis along which two corners differ. */
    std::size_t axis_of(std::size_t from, std::size_t to) const {
        std::size_t axis = 0;
        while (m_parts.corners[from][axis] == m_parts.corners[to][axis]) {
            ++axis;
        }
        return axis;
    }

    /** base, base * factor, .. base * factor^(count - 1) */
    void append_powers(double base, double factor, int count) {
        for (int power = 0; power < count; ++power) {
            m_values.push_back(base);
            base *= factor;
        }
    }

    void append_edge(std::size_t from, std::size_t to) {
        const int count = m_type.order - 1;
        if (is_tensor()) {
            const std::size_t along = axis_of(from, to);
            double base = bubble(m_x[along]);
            for (std::size_t axis = 0; axis < n_axes(); ++axis) {
                base *= axis == along ? 1 : side(from, axis);
            }
            append_powers(base, m_x[along], count);
        } else if (m_type.topology == pyramid && to < 4) {
            const std::size_t along = axis_of(from, to);
            const double base = bubble(ratio(along)) * ratio_side(from, 1 - along) * width() * width();
            append_powers(base, m_x[along], count);
        } else if (m_type.topology == prism && to == from + 3) {
            append_powers(barycentric(from) * bubble(m_x[2]), m_x[2], count);
        } else {
            // Of prisms, the function of the triangle; of pyramids, an edge to the apex.
            const double a = m_type.topology == pyramid ? of_corner(from) : barycentric(from);
            const double b = m_type.topology == pyramid ? m_x[2] : barycentric(to);
            append_powers(a * b * (m_type.topology == prism ? side(from, 2) : 1), b - a, count);
        }
    }

    /** base times the polynomials of degree n - 3 in a triangle; orders are at most 4. */
    void append_triangle(double base, double a, double b, double c) {
        if (m_type.order >= 3) {
            m_values.push_back(base);
        }
        if (m_type.order >= 4) {
            m_values.push_back(base * (a - b));
            m_values.push_back(base * (b - c));
        }
    }

    /** base * x^i * y^j for i, j <= n - 2 */
    void append_square(double base, double x, double y) {
        for (int power = 0; power <= m_type.order - 2; ++power) {
            append_powers(base, x, m_type.order - 1);
            base *= y;
        }
    }

    void append_face(const Face& face) {
        const auto corner = [&](std::size_t which) { return static_cast<std::size_t>(face.corners[which]); };
        if (is_tensor()) {
            const std::size_t along = axis_of(corner(0), corner(1)), across = axis_of(corner(0), corner(3));
            double base = bubble(m_x[along]) * bubble(m_x[across]);
            for (std::size_t axis = 0; axis < n_axes(); ++axis) {
                base *= axis == along || axis == across ? 1 : side(corner(0), axis);
            }
            append_square(base, m_x[along], m_x[across]);
        } else if (m_type.topology == pyramid) {
            append_pyramid_face(face);
        } else if (face.n_corners == 4) {
            const double a = barycentric(corner(0)), b = barycentric(corner(1));
            append_square(a * b * bubble(m_x[2]), b - a, m_x[2]);
        } else {
            const double a = barycentric(corner(0)), b = barycentric(corner(1)), c = barycentric(corner(2));
            append_triangle(a * b * c * (m_type.topology == prism ? side(corner(0), 2) : 1), a, b, c);
        }
    }

    void append_pyramid_face(const Face& face) {
        if (face.n_corners == 4) {
            append_ratios(bubble(ratio(0)) * bubble(ratio(1)) * width() * width());
            return;
        }
        const auto from = static_cast<std::size_t>(face.corners[0]), to = static_cast<std::size_t>(face.corners[1]);
        const std::size_t along = axis_of(from, to);
        const double base = bubble(ratio(along)) * ratio_side(from, 1 - along) * width() * width() * m_x[2];
        // On the face the coordinates of the triangle: the first two differ by x.
        const double difference = m_x[along], a = (width() - difference) / 2, b = (width() + difference) / 2;
        append_triangle(base, a, b, m_x[2]);
    }

    /** base * a^i * b^j * (1 - w)^max(i, j) for i, j <= n - 2, where a and b are the ratios */
    void append_ratios(double base) {
        for (int j = 0; j <= m_type.order - 2; ++j) {
            for (int i = 0; i <= m_type.order - 2; ++i) {
                m_values.push_back(base * std::pow(ratio(0), i) * std::pow(ratio(1), j) * std::pow(width(), std::max(i, j)));
            }
        }
    }

    void append_inside() {
        switch (m_type.topology) {
        case tetrahedron:
            if (m_type.order == 4) {
                m_values.push_back(barycentric(0) * barycentric(1) * barycentric(2) * barycentric(3));
            }
            break;
        case prism: {
            const double a = barycentric(0), b = barycentric(1), c = barycentric(2);
            double base = a * b * c * bubble(m_x[2]);
            for (int power = 0; power <= m_type.order - 2; ++power) {
                append_triangle(base, a, b, c);
                base *= m_x[2];
            }
            break;
        }
        case hexahedron: {
            double base = bubble(m_x[0]) * bubble(m_x[1]) * bubble(m_x[2]);
            for (int power = 0; power <= m_type.order - 2; ++power) {
                append_square(base, m_x[0], m_x[1]);
                base *= m_x[2];
            }
            break;
        }
        case pyramid:
            append_pyramid_inside();
            break;
        default:
            break;
        }
    }

    /** A bubble times the functions of order n - 3, of M. Bergot et al., J. Sci. Comput. 42 (2010). */
    void append_pyramid_inside() {
        const double base = bubble(ratio(0)) * bubble(ratio(1)) * width() * width() * m_x[2];
        const int n = m_type.order - 3;
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j <= n; ++j) {
                const double section = std::pow(ratio(0), i) * std::pow(ratio(1), j) * std::pow(width(), std::max(i, j));
                append_powers(base * section, m_x[2], n - std::max(i, j) + 1);
            }
        }
    }

    const ElementType& m_type;
    const Parts& m_parts;
    const Point& m_x;
    std::vector<double> m_values;
};

} // namespace

std::vector<double> functions(const ElementType& type, const Point& x) { return Values(type, x).all(); }

} // namespace elvis_cgns
