#include "cell_connectivity.hpp"

#include "node_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis_vtk {

namespace {

/** Bends of lines of nodes are evidence if they differ by more than this factor; edges that are much longer than apart may not.
 */
constexpr double clear_overlap_ratio = 1.2;

using Vector = std::array<double, 3>;

/** One file's points and cells. */
struct Mesh {
    std::span<const double> points;
    std::span<std::int64_t> connectivity;

    Vector at(const Cell& cell, std::size_t node) const {
        const auto point = static_cast<std::size_t>(connectivity[cell.first + node]);
        return {points[3 * point], points[3 * point + 1], points[3 * point + 2]};
    }
};

/** Sum of squared second differences along a line of nodes: zero if it is straight and even, large if it zigzags. */
class Line {
public:
    void add(const Vector& x) {
        for (std::size_t i = 0; i < 3 && m_n_points > 1; ++i) {
            const double difference = x[i] - 2 * m_last[i] + m_before[i];
            m_bend += difference * difference;
        }
        m_before = m_last;
        m_last = x;
        ++m_n_points;
    }
    double bend() const { return m_bend; }

private:
    Vector m_last{};
    Vector m_before{};
    std::size_t m_n_points = 0;
    double m_bend = 0;
};

/** Total bend in the order of node_order.hpp and in the other one. */
struct Evidence {
    double standard = 0;
    double other = 0;

    bool is_clearly_other() const { return standard > clear_overlap_ratio * other; }
    bool is_clearly_standard() const { return other > clear_overlap_ratio * standard; }
};

bool has_old_order(const CellKind& kind) {
    return kind.is_of_any_degree && kind.shape == ELVIS_SHAPE_HEXAHEDRON && kind.degree[2] > 1;
}

/** First node of the edges from corners 2 and 3 upward, which the old order exchanges. */
std::array<std::size_t, 2> exchanged_edges(const CellKind& kind) {
    const auto [p, q, r] = kind.degree;
    const std::size_t first = 8 + 4 * (std::size_t(p) - 1) + 4 * (std::size_t(q) - 1) + 2 * (std::size_t(r) - 1);
    return {first, first + r - 1};
}

void weigh_hexahedron(const Mesh& mesh, const Cell& cell, const CellKind& kind, Evidence& evidence) {
    const auto edges = exchanged_edges(kind);
    for (const std::size_t corner : {2u, 3u}) {
        for (const bool is_standard : {true, false}) {
            Line line;
            line.add(mesh.at(cell, corner));
            const std::size_t first = edges[(corner == 2) == is_standard ? 0 : 1];
            for (std::size_t k = 0; k + 1 < kind.degree[2]; ++k) {
                line.add(mesh.at(cell, first + k));
            }
            line.add(mesh.at(cell, corner + 4));
            (is_standard ? evidence.standard : evidence.other) += line.bend();
        }
    }
}

void exchange_edges(const Mesh& mesh, const Cell& cell, const CellKind& kind) {
    const auto edges = exchanged_edges(kind);
    for (std::size_t k = 0; k + 1 < kind.degree[2]; ++k) {
        std::swap(mesh.connectivity[cell.first + edges[0] + k], mesh.connectivity[cell.first + edges[1] + k]);
    }
}

bool has_reversed_face(const CellKind& kind) {
    return kind.family == Family::wedge && kind.degree[0] > 2 && kind.degree[2] > 1;
}

/** First node of the face r = 0, whose rows run from s = 1 to s = 0 since VTK 9.1 and the other way before. */
std::size_t reversed_face(const CellKind& kind) {
    const std::size_t n = kind.degree[0], m = kind.degree[2];
    return 6 + 6 * (n - 1) + 3 * (m - 1) + (n - 1) * (n - 2) + 2 * (n - 1) * (m - 1);
}

void weigh_wedge(const Mesh& mesh, const Cell& cell, const CellKind& kind, Evidence& evidence) {
    const std::size_t n = kind.degree[0], m = kind.degree[2], face = reversed_face(kind), edge = 6 + 6 * (n - 1);
    for (std::size_t k = 0; k + 1 < m; ++k) {
        for (const bool is_standard : {true, false}) {
            Line line;
            line.add(mesh.at(cell, edge + k));
            for (std::size_t j = 0; j + 1 < n; ++j) {
                line.add(mesh.at(cell, face + k * (n - 1) + (is_standard ? n - 2 - j : j)));
            }
            line.add(mesh.at(cell, edge + 2 * (m - 1) + k));
            (is_standard ? evidence.standard : evidence.other) += line.bend();
        }
    }
}

void reverse_face(const Mesh& mesh, const Cell& cell, const CellKind& kind) {
    const std::size_t n = kind.degree[0], m = kind.degree[2];
    for (std::size_t k = 0; k + 1 < m; ++k) {
        const auto row =
            mesh.connectivity.begin() + static_cast<std::ptrdiff_t>(cell.first + reversed_face(kind) + k * (n - 1));
        std::reverse(row, row + static_cast<std::ptrdiff_t>(n - 1));
    }
}

/** Sign of the Jacobian of (r, s, t) at the first corner of a wedge, from its corners. */
int orientation(const Mesh& mesh, const Cell& cell) {
    const Vector o = mesh.at(cell, 0);
    std::array<Vector, 3> e;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector x = mesh.at(cell, i + 1);
        e[i] = {x[0] - o[0], x[1] - o[1], x[2] - o[2]};
    }
    const double determinant = e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
                               e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                               e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
    return determinant > 0 ? 1 : determinant < 0 ? -1 : 0;
}

} // namespace

std::string unify_node_order(std::span<const double> points, std::span<std::int64_t> connectivity, std::span<const Cell> cells,
                             std::vector<CellKind>& kinds, bool declares_old_hexahedra) {
    const Mesh mesh{points, connectivity};
    Evidence hexahedra, wedges;
    bool has_hexahedra = false;
    // (r, s, t) is (xi1, xi3, xi2) or, mirrored, (xi3, xi1, xi2): an odd and an even permutation.
    std::int64_t n_positive = 0;
    for (const Cell& cell : cells) {
        const CellKind& kind = kinds[cell.kind];
        if (has_old_order(kind)) {
            has_hexahedra = true;
            weigh_hexahedron(mesh, cell, kind, hexahedra);
        } else if (has_reversed_face(kind)) {
            weigh_wedge(mesh, cell, kind, wedges);
        }
        if (kind.shape == ELVIS_SHAPE_PRISM) {
            n_positive += orientation(mesh, cell);
        }
    }
    const bool exchange =
        has_hexahedra && (hexahedra.is_clearly_other() || (declares_old_hexahedra && !hexahedra.is_clearly_standard()));
    const bool reverse = wedges.is_clearly_other();
    for (const Cell& cell : cells) {
        const CellKind& kind = kinds[cell.kind];
        if (exchange && has_old_order(kind)) {
            exchange_edges(mesh, cell, kind);
        } else if (reverse && has_reversed_face(kind)) {
            reverse_face(mesh, cell, kind);
        }
    }
    for (CellKind& kind : kinds) {
        kind.is_mirrored = kind.shape == ELVIS_SHAPE_PRISM && n_positive > 0;
    }
    std::string notes;
    if (has_hexahedra && exchange != declares_old_hexahedra) {
        notes += exchange ? "hexahedra are in the node order of VTK 8, although the file's version is 2.1 or later; "
                          : "hexahedra are in the node order of VTK 9, although the file's version is below 2.1; ";
    }
    if (reverse) {
        notes += "wedges are in the node order of VTK 9.0 and older; ";
    }
    return notes;
}

} // namespace elvis_vtk
