#include "interpolation.hpp"

#include <elvis/native/space.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace generator {
namespace {

// P_n^(a,0)(x) in the standard normalisation, by the three-term recurrence.
double jacobi(int n, int a, double x) {
    double previous = 0;
    double current = 1;
    for (int k = 1; k <= n; ++k) {
        const double s = 2.0 * k + a;
        const double next = k == 1
                                ? 0.5 * (a + (a + 2.0) * x)
                                : ((s - 1) * (a * a + (s - 2) * s * x) * current - 2.0 * (k + a - 1) * (k - 1) * s * previous) /
                                      (2.0 * k * (k + a) * (s - 2));
        previous = current;
        current = next;
    }
    return current;
}

double collapsed(double low, double room) { return room == 0 ? -1 : 2 * low / room - 1; }

// Well-conditioned functions that span the space of an order: products of Jacobi polynomials in collapsed coordinates.
std::vector<double> basis(elvis_shape shape, int g, const double* xi) {
    const double l3 = (1 - xi[2]) / 2;
    std::vector<double> values;
    if (shape == ELVIS_SHAPE_HEXAHEDRON) {
        for (int p = 0; p <= g; ++p)
            for (int q = 0; q <= g; ++q)
                for (int r = 0; r <= g; ++r)
                    values.push_back(jacobi(p, 0, xi[0]) * jacobi(q, 0, xi[1]) * jacobi(r, 0, xi[2]));
    } else if (shape == ELVIS_SHAPE_PRISM) {
        const double eta1 = collapsed(1 + xi[0], 1 - xi[2]);
        for (int p = 0; p <= g; ++p)
            for (int q = 0; q <= g; ++q)
                for (int r = 0; r <= g - p; ++r)
                    values.push_back(jacobi(p, 0, eta1) * jacobi(q, 0, xi[1]) * std::pow(l3, p) * jacobi(r, 2 * p + 1, xi[2]));
    } else if (shape == ELVIS_SHAPE_PYRAMID) {
        const double eta1 = collapsed(1 + xi[0], 1 - xi[2]);
        const double eta2 = collapsed(1 + xi[1], 1 - xi[2]);
        for (int p = 0; p <= g; ++p)
            for (int q = 0; q <= g; ++q)
                for (int m = std::max(p, q), r = 0; r <= g - m; ++r)
                    values.push_back(jacobi(p, 0, eta1) * jacobi(q, 0, eta2) * std::pow(l3, m) * jacobi(r, 2 * m + 2, xi[2]));
    } else {
        const double eta1 = collapsed(1 + xi[0], -xi[1] - xi[2]);
        const double eta2 = collapsed(1 + xi[1], 1 - xi[2]);
        for (int p = 0; p <= g; ++p)
            for (int q = 0; q <= g - p; ++q)
                for (int r = 0; r <= g - p - q; ++r)
                    values.push_back(jacobi(p, 0, eta1) * std::pow((1 - eta2) / 2, p) * jacobi(q, 2 * p + 1, eta2) *
                                     std::pow(l3, p + q) * jacobi(r, 2 * (p + q) + 2, xi[2]));
    }
    return values;
}

// Gauss-Lobatto-Legendre nodes of an order, moved to [0, 1].
std::vector<double> unit_nodes(int order) {
    if (order == 0)
        return {0};
    std::vector<double> nodes(static_cast<std::size_t>(order) + 1);
    elvis::native::gauss_lobatto_legendre(nodes);
    for (double& node : nodes)
        node = 0.5 * (1 + node);
    return nodes;
}

// Isaac's nodes: barycentric coordinates of the node with multi-index alpha, by weighing the nodes that it has on the faces
// of the simplex.
std::vector<double> barycentric(const std::vector<int>& alpha) {
    const std::size_t n_corners = alpha.size();
    int order = 0;
    for (int a : alpha)
        order += a;
    const std::vector<double> line = unit_nodes(order);
    const auto at = [&](int i) { return line[static_cast<std::size_t>(i)]; };
    if (n_corners == 1)
        return {1};
    if (n_corners == 2)
        return {at(alpha[0]), at(alpha[1])};
    std::vector<double> result(n_corners, 0.0);
    double sum = 0;
    for (std::size_t i = 0; i < n_corners; ++i) {
        const double weight = at(order - alpha[i]);
        if (weight == 0)
            continue;
        std::vector<int> face = alpha;
        face.erase(face.begin() + static_cast<std::ptrdiff_t>(i));
        std::vector<double> on_face = barycentric(face);
        on_face.insert(on_face.begin() + static_cast<std::ptrdiff_t>(i), 0.0);
        for (std::size_t c = 0; c < n_corners; ++c)
            result[c] += weight * on_face[c];
        sum += weight;
    }
    for (double& value : result)
        value /= sum;
    return result;
}

std::vector<Vec3> hexahedron_nodes(int g) {
    const std::vector<double> z = unit_nodes(g);
    std::vector<Vec3> nodes;
    for (double a : z)
        for (double b : z)
            for (double c : z)
                nodes.push_back({2 * a - 1, 2 * b - 1, 2 * c - 1});
    return nodes;
}

std::vector<Vec3> prism_nodes(int g) {
    const std::vector<double> z = unit_nodes(g);
    std::vector<Vec3> nodes;
    for (int i = 0; i <= g; ++i)
        for (int k = 0; k <= g - i; ++k) {
            const std::vector<double> lambda = barycentric({g - i - k, i, k});
            for (double b : z)
                nodes.push_back({2 * lambda[1] - 1, 2 * b - 1, 2 * lambda[2] - 1});
        }
    return nodes;
}

std::vector<Vec3> tetrahedron_nodes(int g) {
    std::vector<Vec3> nodes;
    for (int i = 0; i <= g; ++i)
        for (int j = 0; j <= g - i; ++j)
            for (int k = 0; k <= g - i - j; ++k) {
                const std::vector<double> lambda = barycentric({g - i - j - k, i, j, k});
                nodes.push_back({2 * lambda[1] - 1, 2 * lambda[2] - 1, 2 * lambda[3] - 1});
            }
    return nodes;
}

// Level k of a pyramid has (g - k + 1)^2 nodes: those of the triangles on its rim, Gauss-Lobatto inside.
std::vector<Vec3> pyramid_nodes(int g) {
    const std::vector<double> height = unit_nodes(g);
    std::vector<Vec3> nodes;
    for (int k = 0; k <= g; ++k) {
        const int m = g - k;
        const std::vector<double> row = unit_nodes(m);
        for (int i = 0; i <= m; ++i)
            for (int j = 0; j <= m; ++j) {
                const bool rim_i = i == 0 || i == m;
                const bool rim_j = j == 0 || j == m;
                // Unit coordinates (a, b, c): the section at height c is the square [0, 1 - c]^2.
                double a;
                double b;
                double c;
                if (rim_i || rim_j) {
                    const int along = rim_j ? i : j;
                    const std::vector<double> lambda = barycentric({m - along, along, k});
                    c = lambda[2];
                    a = rim_j ? lambda[1] : (i == 0 ? 0 : 1 - c);
                    b = rim_j ? (j == 0 ? 0 : 1 - c) : lambda[1];
                } else {
                    c = height[static_cast<std::size_t>(k)];
                    a = row[static_cast<std::size_t>(i)] * (1 - c);
                    b = row[static_cast<std::size_t>(j)] * (1 - c);
                }
                nodes.push_back({2 * a - 1, 2 * b - 1, 2 * c - 1});
            }
    }
    return nodes;
}

std::vector<Vec3> make_nodes(elvis_shape shape, int g) {
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON:
        return hexahedron_nodes(g);
    case ELVIS_SHAPE_PRISM:
        return prism_nodes(g);
    case ELVIS_SHAPE_PYRAMID:
        return pyramid_nodes(g);
    default:
        return tetrahedron_nodes(g);
    }
}

std::atomic<std::uint64_t> next_serial{1};

} // namespace

Interpolation::Interpolation(elvis_shape shape, std::uint32_t order)
    : m_shape(shape), m_order(static_cast<int>(order)), m_serial(next_serial++), m_nodes(make_nodes(shape, m_order)) {
    const auto n = static_cast<Eigen::Index>(m_nodes.size());
    Eigen::MatrixXd vandermonde(n, n);
    for (Eigen::Index node = 0; node < n; ++node) {
        const std::vector<double> row = basis(m_shape, m_order, m_nodes[static_cast<std::size_t>(node)].data());
        vandermonde.row(node) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), n);
    }
    m_inverse = vandermonde.inverse();
}

const Eigen::MatrixXd& Interpolation::weights(std::span<const double> xi) const {
    struct Kept {
        std::uint64_t serial = 0;
        std::vector<double> xi;
        Eigen::MatrixXd weights;
    };
    thread_local std::array<Kept, 4> kept;
    thread_local std::size_t oldest = 0;
    for (const Kept& entry : kept)
        if (entry.serial == m_serial && std::ranges::equal(entry.xi, xi))
            return entry.weights;

    Kept& entry = kept[oldest];
    oldest = (oldest + 1) % kept.size();
    entry.serial = m_serial;
    entry.xi.assign(xi.begin(), xi.end());
    const auto n_points = static_cast<Eigen::Index>(xi.size() / 3);
    Eigen::MatrixXd values(n_points, m_inverse.rows());
    for (Eigen::Index point = 0; point < n_points; ++point) {
        const std::vector<double> row = basis(m_shape, m_order, xi.data() + 3 * point);
        values.row(point) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), m_inverse.rows());
    }
    entry.weights = values * m_inverse;
    return entry.weights;
}

} // namespace generator
