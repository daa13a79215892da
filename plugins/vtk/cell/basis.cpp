#include "basis.hpp"

#include "line_positions.hpp"

#include <algorithm>
#include <array>

namespace elvis_vtk {

namespace {

using Table = std::array<double, max_degree + 1>;

/** Lagrange polynomials of degree n on the nodes of a spacing, or Bernstein polynomials, at x in [0,1]. */
Table line_functions(const CellKind& kind, int n, double x) {
    Table values{};
    if (kind.is_bezier) {
        // b(i, n) = (1 - x) b(i, n - 1) + x b(i - 1, n - 1)
        values[0] = 1;
        for (std::size_t degree = 1; degree <= static_cast<std::size_t>(n); ++degree) {
            for (std::size_t i = degree; i > 0; --i) {
                values[i] = (1 - x) * values[i] + x * values[i - 1];
            }
            values[0] *= 1 - x;
        }
        return values;
    }
    if (n == 0) {
        values[0] = 1;
        return values;
    }
    const std::span<const double> at = line_positions(kind.is_lobatto ? Spacing::lobatto : Spacing::equidistant, n);
    for (std::size_t i = 0; i < at.size(); ++i) {
        values[i] = 1;
        for (std::size_t j = 0; j < at.size(); ++j) {
            values[i] *= j == i ? 1 : (x - at[j]) / (at[i] - at[j]);
        }
    }
    return values;
}

/**
 * Factors of functions on simplices at one barycentric coordinate, by exponent b. Lagrange (P. Silvester, 1969): the product of
 * (n x - a) / (a + 1) over a < b. Bernstein: x^b / b!, to be multiplied by n!.
 */
Table simplex_factors(int n, double x, bool is_bezier) {
    Table values{};
    values[0] = 1;
    for (int b = 1; b <= n; ++b) {
        values[static_cast<std::size_t>(b)] = values[static_cast<std::size_t>(b - 1)] * (is_bezier ? x : n * x - (b - 1)) / b;
    }
    return values;
}

double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

std::size_t index(int i) { return static_cast<std::size_t>(i); }

/** Functions on the triangle or, with is_solid, the tetrahedron. */
void simplex_functions(int n, bool is_bezier, bool is_solid, const std::vector<LatticePoint>& nodes, const double* r,
                       std::span<double> values) {
    const double last = 1 - r[0] - r[1] - (is_solid ? r[2] : 0);
    const Table a = simplex_factors(n, r[0], is_bezier), b = simplex_factors(n, r[1], is_bezier),
                c = simplex_factors(n, is_solid ? r[2] : 0, is_bezier), d = simplex_factors(n, last, is_bezier);
    const double factor = is_bezier ? factorial(n) : 1;
    for (std::size_t node = 0; node < nodes.size(); ++node) {
        const auto [i, j, k] = nodes[node];
        values[node] =
            factor * a[index(i)] * b[index(j)] * (is_solid ? c[index(k)] : 1) * d[index(n - i - j - (is_solid ? k : 0))];
    }
}

/** Signs of a hexahedron's corners in (-1,1)^3, its first four those of a quadrilateral. */
constexpr int corner_signs[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
/** Signs of the middles of a hexahedron's edges; 0 along the edge. */
constexpr int edge_signs[12][3] = {{0, -1, -1}, {1, 0, -1}, {0, 1, -1},  {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},
                                   {0, 1, 1},   {-1, 0, 1}, {-1, -1, 0}, {1, -1, 0},  {1, 1, 0},  {-1, 1, 0}};

/** The factor of a serendipity function in one direction: a quadratic that vanishes at both ends, or half a line. */
double serendipity_factor(int sign, double x) { return sign == 0 ? 1 - x * x : 0.5 * (1 + sign * x); }

/** Serendipity quadrilateral (O. C. Zienkiewicz, The Finite Element Method): corners, then edges as in edge_signs. */
std::array<double, 8> quadrilateral_8(double x, double y) {
    std::array<double, 8> values{};
    for (std::size_t corner = 0; corner < 4; ++corner) {
        const auto& sign = corner_signs[corner];
        values[corner] = serendipity_factor(sign[0], x) * serendipity_factor(sign[1], y) * (sign[0] * x + sign[1] * y - 1);
        values[4 + corner] = serendipity_factor(edge_signs[corner][0], x) * serendipity_factor(edge_signs[corner][1], y);
    }
    return values;
}

/** Serendipity hexahedron: corners, then edges. */
std::array<double, 20> hexahedron_20(double x, double y, double z) {
    std::array<double, 20> values{};
    for (std::size_t corner = 0; corner < 8; ++corner) {
        const auto& sign = corner_signs[corner];
        values[corner] = serendipity_factor(sign[0], x) * serendipity_factor(sign[1], y) * serendipity_factor(sign[2], z) *
                         (sign[0] * x + sign[1] * y + sign[2] * z - 2);
    }
    for (std::size_t edge = 0; edge < 12; ++edge) {
        const auto& sign = edge_signs[edge];
        values[8 + edge] = serendipity_factor(sign[0], x) * serendipity_factor(sign[1], y) * serendipity_factor(sign[2], z);
    }
    return values;
}

/** Quadratic functions with their nodes at -1, 1 and 0. */
std::array<double, 3> quadratic(double z) { return {0.5 * z * (z - 1), 0.5 * z * (z + 1), 1 - z * z}; }

void hexahedron_24(double x, double y, double z, std::span<double> values) {
    const std::array<double, 8> plane = quadrilateral_8(x, y);
    const std::array<double, 3> line = quadratic(z);
    for (std::size_t i = 0; i < 4; ++i) {
        values[i] = plane[i] * line[0];
        values[4 + i] = plane[i] * line[1];
        values[8 + i] = plane[4 + i] * line[0];
        values[12 + i] = plane[4 + i] * line[1];
        values[16 + i] = plane[i] * line[2];
    }
    // Faces r = 0, r = 1, s = 0, s = 1 over the edges of the quadrilateral.
    values[20] = plane[7] * line[2];
    values[21] = plane[5] * line[2];
    values[22] = plane[4] * line[2];
    values[23] = plane[6] * line[2];
}

/** Corners 012, 345, edges of both triangles, edges between them; l: barycentric, z in [-1,1]. */
void wedge_15(const std::array<double, 3>& l, double z, std::span<double> values) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        for (std::size_t side = 0; side < 2; ++side) {
            const double end = 0.5 * (1 + (side == 0 ? -z : z));
            values[3 * side + i] = end * l[i] * (2 * l[i] - 1) - 0.5 * l[i] * (1 - z * z);
            values[6 + 3 * side + i] = 4 * l[i] * l[next] * end;
        }
        values[12 + i] = l[i] * (1 - z * z);
    }
}

/** Quadratic functions corrected to vanish at the centre, and the bubble that is one there. */
std::array<double, 7> triangle_7(const std::array<double, 3>& l) {
    const double bubble = l[0] * l[1] * l[2];
    std::array<double, 7> values{};
    for (std::size_t i = 0; i < 3; ++i) {
        values[i] = l[i] * (2 * l[i] - 1) + 3 * bubble;
        values[3 + i] = 4 * l[i] * l[(i + 1) % 3] - 12 * bubble;
    }
    values[6] = 27 * bubble;
    return values;
}

void wedge_21(const std::array<double, 3>& l, double z, std::span<double> values) {
    const std::array<double, 7> plane = triangle_7(l);
    const std::array<double, 3> line = quadratic(z);
    for (std::size_t i = 0; i < 3; ++i) {
        values[i] = plane[i] * line[0];
        values[3 + i] = plane[i] * line[1];
        values[6 + i] = plane[3 + i] * line[0];
        values[9 + i] = plane[3 + i] * line[1];
        values[12 + i] = plane[i] * line[2];
        values[17 + i] = plane[3 + i] * line[2];
    }
    values[15] = plane[6] * line[0];
    values[16] = plane[6] * line[1];
    values[20] = plane[6] * line[2];
}

/**
 * Ten quadratic functions, four face bubbles and one inside, each corrected to vanish at the nodes of later ones: the quadratic
 * function of a corner is -1/9 at the centres of its faces and -1/8 inside, that of an edge 4/9 and 1/4, a face bubble 27/64.
 */
void tetrahedron_15(const std::array<double, 4>& l, std::span<double> values) {
    constexpr std::size_t faces[4][3] = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}};
    constexpr std::size_t edges[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    const double inside = 256 * l[0] * l[1] * l[2] * l[3];
    values[14] = inside;
    for (std::size_t face = 0; face < 4; ++face) {
        const auto& f = faces[face];
        values[10 + face] = 27 * l[f[0]] * l[f[1]] * l[f[2]] - 27.0 / 64 * inside;
    }
    const auto contains = [&](std::size_t face, std::size_t corner) {
        return faces[face][0] == corner || faces[face][1] == corner || faces[face][2] == corner;
    };
    for (std::size_t corner = 0; corner < 4; ++corner) {
        values[corner] = l[corner] * (2 * l[corner] - 1) + inside / 8;
        for (std::size_t face = 0; face < 4; ++face) {
            values[corner] += contains(face, corner) ? values[10 + face] / 9 : 0;
        }
    }
    for (std::size_t edge = 0; edge < 6; ++edge) {
        const auto [a, b] = edges[edge];
        values[4 + edge] = 4 * l[a] * l[b] - inside / 4;
        for (std::size_t face = 0; face < 4; ++face) {
            values[4 + edge] -= contains(face, a) && contains(face, b) ? 4 * values[10 + face] / 9 : 0;
        }
    }
}

/** In collapsed coordinates the functions of a hexahedron whose upper corners are one. */
void pyramid_5(double x, double y, double z, std::span<double> values) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
        const auto& sign = corner_signs[corner];
        values[corner] = serendipity_factor(sign[0], x) * serendipity_factor(sign[1], y) * 0.5 * (1 - z);
    }
    values[4] = 0.5 * (1 + z);
}

/**
 * As VTK 9 has them: those of a serendipity hexahedron whose upper nodes are one (K.-J. Bathe, Finite Element
 * Procedures, 5.3.2), with the corrections that make the triangular faces quadratic triangles. z is 1 at the apex.
 */
void pyramid_13(double x, double y, double z, std::span<double> values) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
        const double sx = corner_signs[corner][0] * x, sy = corner_signs[corner][1] * y;
        values[corner] =
            (1 + sx) * (1 + sy) * (1 - z) * (-4 + 3 * (sx + sy) - 2 * sx * sy - 2 * z + (sx + sy) * z - 2 * sx * sy * z) / 16;
        values[9 + corner] = 0.25 * (1 + sx) * (1 + sy) * (1 - z * z);
        // Of the two signs of an edge one is zero.
        const double sum = edge_signs[corner][0] * x + edge_signs[corner][1] * y;
        const double along = edge_signs[corner][0] == 0 ? x : y;
        values[5 + corner] = 0.125 * (1 - along * along) * (1 + sum) * (1 - z) * (2 - sum - sum * z);
    }
    values[4] = 0.5 * z * (1 + z);
}

/** r, s, t of VTK in [0,1]. */
std::array<double, 3> vtk_coordinates(const CellKind& kind, const double* xi) {
    const std::array<double, 3> r{0.5 * (1 + xi[0]), 0.5 * (1 + xi[1]), 0.5 * (1 + xi[2])};
    if (kind.shape == ELVIS_SHAPE_PRISM) {
        return kind.is_mirrored ? std::array<double, 3>{r[2], r[0], r[1]} : std::array<double, 3>{r[0], r[2], r[1]};
    }
    if (kind.shape == ELVIS_SHAPE_PYRAMID) {
        // Collapsed coordinates; at the apex all functions but the apex's own vanish, whatever r and s.
        const double width = 1 - r[2];
        return width > 0 ? std::array<double, 3>{r[0] / width, r[1] / width, r[2]} : std::array<double, 3>{0, 0, 1};
    }
    return r;
}

} // namespace

Basis::Basis(const CellKind& kind) : m_kind(kind), m_size(n_nodes(kind)), m_nodes(lattice_nodes(kind)) {}

void Basis::evaluate(const double* xi, std::span<double> values) const {
    const std::array<double, 3> r = vtk_coordinates(m_kind, xi);
    const std::array<double, 3> x{2 * r[0] - 1, 2 * r[1] - 1, 2 * r[2] - 1};
    const std::array<double, 3> in_triangle{1 - r[0] - r[1], r[0], r[1]};
    switch (m_kind.family) {
    case Family::tensor: {
        const Table a = line_functions(m_kind, m_kind.degree[0], r[0]), b = line_functions(m_kind, m_kind.degree[1], r[1]),
                    c = line_functions(m_kind, m_kind.degree[2], r[2]);
        for (std::size_t node = 0; node < m_size; ++node) {
            const auto [i, j, k] = m_nodes[node];
            values[node] = a[index(i)] * b[index(j)] * c[index(k)];
        }
        break;
    }
    case Family::simplex:
        simplex_functions(m_kind.degree[0], m_kind.is_bezier, m_kind.shape == ELVIS_SHAPE_TETRAHEDRON, m_nodes, r.data(),
                          values);
        break;
    case Family::wedge: {
        simplex_functions(m_kind.degree[0], m_kind.is_bezier, false, m_nodes, r.data(), values);
        const Table c = line_functions(m_kind, m_kind.degree[2], r[2]);
        for (std::size_t node = 0; node < m_size; ++node) {
            values[node] *= c[index(m_nodes[node][2])];
        }
        break;
    }
    case Family::quadrilateral_8: {
        const std::array<double, 8> all = quadrilateral_8(x[0], x[1]);
        std::copy(all.begin(), all.end(), values.begin());
        break;
    }
    case Family::hexahedron_20: {
        const std::array<double, 20> all = hexahedron_20(x[0], x[1], x[2]);
        std::copy(all.begin(), all.end(), values.begin());
        break;
    }
    case Family::hexahedron_24:
        hexahedron_24(x[0], x[1], x[2], values);
        break;
    case Family::wedge_15:
        wedge_15(in_triangle, x[2], values);
        break;
    case Family::triangle_7: {
        const std::array<double, 7> all = triangle_7(in_triangle);
        std::copy(all.begin(), all.end(), values.begin());
        break;
    }
    case Family::tetrahedron_15:
        tetrahedron_15({1 - r[0] - r[1] - r[2], r[0], r[1], r[2]}, values);
        break;
    case Family::wedge_21:
        wedge_21(in_triangle, x[2], values);
        break;
    case Family::pyramid_5:
        pyramid_5(x[0], x[1], x[2], values);
        break;
    case Family::pyramid_13:
        pyramid_13(x[0], x[1], x[2], values);
        break;
    }
}

} // namespace elvis_vtk
