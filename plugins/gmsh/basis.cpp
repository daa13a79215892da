#include "basis.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace gmsh {

namespace {

using enum Topology;

std::atomic<std::uint64_t> next_serial{1};

/** Legendre polynomials 0..n at x. */
void legendre(int n, double x, double* values) {
    values[0] = 1;
    if (n >= 1) {
        values[1] = x;
    }
    for (int k = 2; k <= n; ++k) {
        values[k] = ((2 * k - 1) * x * values[k - 1] - (k - 1) * values[k - 2]) / k;
    }
}

/** Jacobi polynomial P_k^(alpha,0) at x, by the three-term recurrence. */
double jacobi(int k, double alpha, double x) {
    double before = 1;
    if (k == 0) {
        return before;
    }
    double now = 0.5 * (alpha + (alpha + 2) * x);
    for (int m = 2; m <= k; ++m) {
        const double a1 = 2 * m * (m + alpha) * (2 * m + alpha - 2);
        const double a2 = (2 * m + alpha - 1) * alpha * alpha;
        const double a3 = (2 * m + alpha - 2) * (2 * m + alpha - 1) * (2 * m + alpha);
        const double a4 = 2 * (m + alpha - 1) * (m - 1) * (2 * m + alpha);
        const double next = ((a2 + a3 * x) * now - a4 * before) / a1;
        before = now;
        now = next;
    }
    return now;
}

/**
 * Products k = 0..n of (n lambda - l) / (l + 1), l < k: one at lambda = k/n, zero at smaller multiples of 1/n. The factor of
 * Silvester's closed form of Lagrange polynomials on equispaced simplices (P. Silvester, Int. J. Eng. Sci. 7 (1969) 849-861);
 * with two barycentric coordinates that of a line.
 */
void silvester(int n, double lambda, double* values) {
    values[0] = 1;
    for (int k = 1; k <= n; ++k) {
        values[k] = values[k - 1] * (n * lambda - (k - 1)) / k;
    }
}

/** Complete bases of all shapes but the pyramid, in closed form. */
class ClosedLagrange final : public Basis {
public:
    explicit ClosedLagrange(const ElementType& type) : m_order(type.order), m_lattice(lattice(type)) {
        const auto n = static_cast<std::uint32_t>(type.order);
        describe(type.topology, m_lattice.size(), {n, n, dimension(type.topology) == 3 ? n : 0});
    }

private:
    Eigen::MatrixXd evaluate(const Eigen::Matrix3Xd& points) const override {
        Eigen::MatrixXd result(points.cols(), static_cast<Eigen::Index>(size()));
        for (Eigen::Index point = 0; point < points.cols(); ++point) {
            const Factors factors = factors_at(points.col(point));
            for (std::size_t node = 0; node < m_lattice.size(); ++node) {
                result(point, static_cast<Eigen::Index>(node)) = product(factors, m_lattice[node]);
            }
        }
        return result;
    }

    /** Factors of each barycentric coordinate: at most two for each of three axes. */
    using Factors = std::array<std::array<double, max_type_order + 1>, 6>;

    Factors factors_at(const Eigen::Vector3d& x) const {
        std::array<double, 6> lambda{};
        switch (topology()) {
        case triangle:
            lambda = {x[0], x[1], 1 - x[0] - x[1]};
            break;
        case tetrahedron:
            lambda = {x[0], x[1], x[2], 1 - x[0] - x[1] - x[2]};
            break;
        case prism:
            lambda = {x[0], x[1], 1 - x[0] - x[1], 0.5 * (1 + x[2]), 0.5 * (1 - x[2])};
            break;
        default:
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double along = x[static_cast<Eigen::Index>(axis)];
                lambda[2 * axis] = 0.5 * (1 + along);
                lambda[2 * axis + 1] = 0.5 * (1 - along);
            }
        }
        Factors factors{};
        for (std::size_t which = 0; which < 6; ++which) {
            silvester(m_order, lambda[which], factors[which].data());
        }
        return factors;
    }

    double product(const Factors& factors, const LatticeIndex& index) const {
        const auto factor = [&](std::size_t which, int at) { return factors[which][static_cast<std::size_t>(at)]; };
        const auto [i, j, k] = index;
        const auto along = [&](std::size_t first, int at) { return factor(first, at) * factor(first + 1, m_order - at); };
        switch (topology()) {
        case triangle:
            return factor(0, i) * factor(1, j) * factor(2, m_order - i - j);
        case tetrahedron:
            return factor(0, i) * factor(1, j) * factor(2, k) * factor(3, m_order - i - j - k);
        case prism:
            return factor(0, i) * factor(1, j) * factor(2, m_order - i - j) * along(3, k);
        case quadrilateral:
            return along(0, i) * along(2, j);
        default:
            return along(0, i) * along(2, j) * along(4, k);
        }
    }

    int m_order;
    std::vector<LatticeIndex> m_lattice;
};

/** Appends functions of a space at a point. */
using Functions = std::vector<double>;

/**
 * Space of serendipity triangles (`n_axes` 2) and tetrahedra (3): powers of single coordinates up to n, and products of two
 * coordinates of total degree n.
 */
void append_simplex(int n, std::size_t n_axes, const double* x, Functions& out) {
    std::array<std::array<double, max_type_order + 1>, 3> in_axis{};
    out.push_back(1);
    for (std::size_t axis = 0; axis < n_axes; ++axis) {
        legendre(n, 2 * x[axis] - 1, in_axis[axis].data());
        out.insert(out.end(), in_axis[axis].begin() + 1, in_axis[axis].begin() + 1 + n);
    }
    for (std::size_t first = 0; first < n_axes; ++first) {
        for (std::size_t second = first + 1; second < n_axes; ++second) {
            double binomial = 1;
            for (int power = 1; power < n; ++power) {
                binomial *= static_cast<double>(n - power + 1) / power;
                out.push_back(binomial * std::pow(x[first], power) * std::pow(x[second], n - power));
            }
        }
    }
}

/** Legendre polynomials of one coordinate up to n, times those of degree 0 and 1 in each other coordinate. */
void append_box(int n, std::size_t n_axes, const double* x, Functions& out) {
    for (std::size_t axis = 0; axis < n_axes; ++axis) {
        std::array<double, max_type_order + 1> in_axis{};
        legendre(n, x[axis], in_axis.data());
        for (int degree = axis == 0 ? 0 : 2; degree <= n; ++degree) {
            for (unsigned linear = 0; linear < 1u << (n_axes - 1); ++linear) {
                double value = in_axis[static_cast<std::size_t>(degree)];
                unsigned bit = 0;
                for (std::size_t other = 0; other < n_axes; ++other) {
                    if (other != axis && (linear >> bit++ & 1u)) {
                        value *= x[other];
                    }
                }
                out.push_back(value);
            }
        }
    }
}

/** Space of the serendipity triangle times {1, w}, and powers of w up to n times {1, u, v}. */
void append_prism(int n, const double* x, Functions& out) {
    append_simplex(n, 2, x, out);
    const std::size_t count = out.size();
    for (std::size_t index = 0; index < count; ++index) {
        out.push_back(out[index] * x[2]);
    }
    std::array<double, max_type_order + 1> in_height{};
    legendre(n, x[2], in_height.data());
    for (int degree = 2; degree <= n; ++degree) {
        const double value = in_height[static_cast<std::size_t>(degree)];
        out.insert(out.end(), {value, value * x[0], value * x[1]});
    }
}

/**
 * Space of M. Bergot, G. Cohen, M. Durufle, "Higher-order finite elements for hybrid meshes using new nodal pyramidal
 * elements", J. Sci. Comput. 42 (2010) 345-381. Serendipity: only those with i + j <= n, or i + j = n + 1 and a factor of
 * degree 1.
 */
void append_pyramid(int n, bool is_serendipity, const double* x, Functions& out) {
    const double rest = 1 - x[2];
    // At the apex all functions that depend on the ratios vanish.
    const double a = rest != 0 ? x[0] / rest : 0, b = rest != 0 ? x[1] / rest : 0;
    std::array<double, max_type_order + 1> in_a{}, in_b{};
    legendre(n, a, in_a.data());
    legendre(n, b, in_b.data());
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            if (is_serendipity && i + j > n && !(i + j == n + 1 && (i == 1 || j == 1))) {
                continue;
            }
            const int larger = std::max(i, j);
            const double factor =
                in_a[static_cast<std::size_t>(i)] * in_b[static_cast<std::size_t>(j)] * std::pow(rest, larger);
            for (int k = 0; k <= n - larger; ++k) {
                out.push_back(factor * jacobi(k, 2 * larger + 2, 2 * x[2] - 1));
            }
        }
    }
}

/** Serendipity bases and those of pyramids, by the inverse of a generalised Vandermonde matrix. */
class SolvedLagrange final : public Basis {
public:
    explicit SolvedLagrange(const ElementType& type) : m_type(type) {
        const auto n = static_cast<std::uint32_t>(type.order);
        describe(type.topology, n_nodes(type), {n, n, dimension(type.topology) == 3 ? n : 0});
        Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(size()));
        Eigen::Index column = 0;
        for (const LatticeIndex& index : lattice(type)) {
            const std::array<double, 3> point = lattice_point(type.topology, type.order, index);
            points.col(column++) = Eigen::Map<const Eigen::Vector3d>(point.data());
        }
        m_inverse = functions(points).inverse();
    }

private:
    Eigen::MatrixXd functions(const Eigen::Matrix3Xd& points) const {
        Eigen::MatrixXd result(points.cols(), static_cast<Eigen::Index>(size()));
        Functions row;
        for (Eigen::Index point = 0; point < points.cols(); ++point) {
            const double* x = points.data() + 3 * point;
            row.clear();
            switch (m_type.topology) {
            case triangle:
                append_simplex(m_type.order, 2, x, row);
                break;
            case tetrahedron:
                append_simplex(m_type.order, 3, x, row);
                break;
            case quadrilateral:
                append_box(m_type.order, 2, x, row);
                break;
            case prism:
                append_prism(m_type.order, x, row);
                break;
            case pyramid:
                append_pyramid(m_type.order, m_type.is_serendipity, x, row);
                break;
            default:
                append_box(m_type.order, 3, x, row);
            }
            result.row(point) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), result.cols());
        }
        return result;
    }

    Eigen::MatrixXd evaluate(const Eigen::Matrix3Xd& points) const override { return functions(points) * m_inverse; }

    ElementType m_type;
    Eigen::MatrixXd m_inverse;
};

class Constant final : public Basis {
public:
    explicit Constant(Topology topology) { describe(topology, 1, {0, 0, 0}); }

private:
    Eigen::MatrixXd evaluate(const Eigen::Matrix3Xd& points) const override { return Eigen::MatrixXd::Ones(points.cols(), 1); }
};

} // namespace

std::span<const int> source_corners(Topology topology) {
    static constexpr std::array same{0, 1, 2, 3, 4, 5, 6, 7};
    static constexpr std::array of_prism{0, 2, 5, 3, 1, 4};
    return {topology == prism ? of_prism.data() : same.data(), static_cast<std::size_t>(n_corners(topology))};
}

std::array<double, 3> source_point(Topology topology, const double* xi) {
    switch (topology) {
    case triangle:
        return {0.5 * (1 + xi[0]), 0.5 * (1 + xi[1]), 0};
    case tetrahedron:
        return {0.5 * (1 + xi[0]), 0.5 * (1 + xi[1]), 0.5 * (1 + xi[2])};
    case prism:
        return {0.5 * (1 + xi[2]), 0.5 * (1 + xi[0]), xi[1]};
    case pyramid:
        return {xi[0] + 0.5 * (1 + xi[2]), xi[1] + 0.5 * (1 + xi[2]), 0.5 * (1 + xi[2])};
    case quadrilateral:
        return {xi[0], xi[1], 0};
    default:
        return {xi[0], xi[1], xi[2]};
    }
}

Basis::Basis() : m_serial(next_serial++) {}

const Eigen::MatrixXd& Basis::weights(std::span<const double> xi) const {
    struct Kept {
        std::uint64_t serial = 0;
        std::vector<double> xi;
        Eigen::MatrixXd weights;
    };
    thread_local std::array<Kept, 8> kept;
    thread_local std::size_t oldest = 0;
    for (const Kept& entry : kept) {
        if (entry.serial == m_serial && std::ranges::equal(entry.xi, xi)) {
            return entry.weights;
        }
    }
    Kept& entry = kept[oldest];
    oldest = (oldest + 1) % kept.size();
    // While it is being replaced it answers for nothing.
    entry.serial = 0;
    entry.xi.assign(xi.begin(), xi.end());
    Eigen::Matrix3Xd points(3, static_cast<Eigen::Index>(xi.size() / 3));
    for (Eigen::Index point = 0; point < points.cols(); ++point) {
        const std::array<double, 3> x = source_point(m_topology, xi.data() + 3 * point);
        points.col(point) = Eigen::Map<const Eigen::Vector3d>(x.data());
    }
    entry.weights = evaluate(points);
    entry.serial = m_serial;
    return entry.weights;
}

bool has_lagrange_basis(const ElementType& type) {
    return dimension(type.topology) >= 2 && !(type.topology == pyramid && type.is_serendipity && type.order > 2);
}

std::unique_ptr<Basis> lagrange_basis(const ElementType& type) {
    if (type.is_serendipity || type.topology == pyramid) {
        return std::make_unique<SolvedLagrange>(type);
    }
    return std::make_unique<ClosedLagrange>(type);
}

std::unique_ptr<Basis> constant_basis(Topology topology) { return std::make_unique<Constant>(topology); }

} // namespace gmsh
