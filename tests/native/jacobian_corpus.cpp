/*
 * Five constructions, each followed by a random affine map with positive determinant and a shift:
 *
 * 1. xi + g(xi), the row sums of |dg_i/dxi_j| being at most 0.95 by the sum of the terms' magnitudes on [-1,1]^3: I + dg is
 *    dominated by its diagonal, so that the determinant is positive.
 * 2. y_a = int q dxi_a + s(xi_b, xi_c), y_b = xi_b + t(xi_c), y_c = xi_c: the Jacobian is triangular with determinant q. Chosen
 *    as delta + a sum of squares that vanish at a known point of the shape, or as delta + c.(1 + xi): its minimum is delta > 0.
 * 3. The same with delta < 0: negative at that point.
 * 4. Any of these behind a reflection: negative everywhere.
 * 5. Straight elements. Corners moved by so little that dg is small as in 1: positive. A corner v moved to v + t (m - v), m the
 *    mean of its three neighbours, t > 1: the three edges at v then span a negative volume, and the Jacobian at v is half of
 *    each. Tetrahedra with t < 1 are positive.
 */
#include "jacobian_corpus.hpp"

#include "spaces.hpp"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <tuple>

namespace elvis::native {
namespace {

using Mapping = std::function<Point(const Point&)>;

struct Term {
    std::array<int, 3> power;
    double coefficient;
};
using Polynomial = std::vector<Term>;

double value(const Polynomial& polynomial, const Point& xi) {
    double sum = 0;
    for (const Term& term : polynomial)
        sum +=
            term.coefficient * std::pow(xi[0], term.power[0]) * std::pow(xi[1], term.power[1]) * std::pow(xi[2], term.power[2]);
    return sum;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
    Polynomial result;
    for (const Term& s : a)
        for (const Term& t : b)
            result.push_back(
                {{s.power[0] + t.power[0], s.power[1] + t.power[1], s.power[2] + t.power[2]}, s.coefficient * t.coefficient});
    return result;
}

class Maker {
public:
    explicit Maker(unsigned seed) : m_points(seed) {}

    CorpusElement valid_bend(Shape shape) {
        const int order = 2 + pick(3);
        std::array<Polynomial, 3> g;
        for (Polynomial& component : g) {
            double sum = 0;
            for (int a = 0; a <= order; ++a)
                for (int b = 0; a + b <= order; ++b)
                    for (int c = 0; a + b + c <= order; ++c) {
                        component.push_back({{a, b, c}, m_points.number()});
                        sum += std::abs(component.back().coefficient) * (a + b + c);
                    }
            for (Term& term : component)
                term.coefficient *= 0.95 / sum;
        }
        return make(
            shape, order,
            [g](const Point& xi) {
                return Point{xi[0] + value(g[0], xi), xi[1] + value(g[1], xi), xi[2] + value(g[2], xi)};
            },
            false, "bend");
    }

    CorpusElement shear(Shape shape, double delta) {
        const int order = 2 + pick(3);
        // With fewer than three squares the minimum lies along a line or plane across the element, and telling its sign takes
        // parts in proportion to 1/sqrt(delta) or 1/delta.
        const int n_squares = std::abs(delta) > 1e-2 ? 1 + pick(3) : 3;
        const std::size_t a = static_cast<std::size_t>(pick(3)), b = (a + 1) % 3, c = (a + 2) % 3;
        Polynomial q{{{0, 0, 0}, delta}};
        const auto add = [&q](const Polynomial& other) { q.insert(q.end(), other.begin(), other.end()); };
        if (order == 2)
            for (std::size_t i = 0; i < 3; ++i) {
                Term term{{0, 0, 0}, pick(3) == 0 ? 0 : std::abs(m_points.number())};
                add({term});
                term.power[i] = 1;
                add({term});
            }
        else {
            const Point least = m_points.xi(shape);
            for (int i = 0; i < n_squares; ++i) {
                Polynomial linear;
                double constant = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    Term term{{0, 0, 0}, 0.4 * m_points.number() + (static_cast<int>(k) == i ? 1 : 0)};
                    term.power[k] = 1;
                    constant -= term.coefficient * least[k];
                    linear.push_back(term);
                }
                linear.push_back({{0, 0, 0}, constant});
                add(product(linear, linear));
            }
        }
        Polynomial first = q;
        for (Term& term : first)
            term.coefficient /= ++term.power[a];
        Polynomial second;
        for (int i = 0; i <= order; ++i)
            for (int j = 0; i + j <= order; ++j) {
                Term term{{0, 0, 0}, 0.3 * m_points.number()};
                term.power[b] = i;
                term.power[c] = j;
                first.push_back(term);
                if (i == 0)
                    second.push_back(term);
            }
        return make(
            shape, order,
            [=](const Point& xi) {
                Point y = xi;
                y[a] = value(first, xi);
                y[b] = xi[b] + value(second, xi);
                return y;
            },
            delta < 0, "shear with minimum " + std::to_string(delta));
    }

    CorpusElement inverted(Shape shape) {
        m_sign = -1;
        CorpusElement element = pick(2) == 0 ? valid_bend(shape) : shear(shape, 0.1);
        m_sign = 1;
        element.is_negative = true;
        element.origin += ", reflected";
        return element;
    }

    CorpusElement straight(Shape shape) {
        std::vector<Point> corners;
        for (int i = 0; i < n_corners(shape); ++i)
            corners.push_back(corner(shape, i));
        const double reach = shape == Shape::pyramid ? 0.19 : 0.3;
        for (Point& point : corners)
            for (double& x : point)
                x += reach * m_points.number();
        return make_straight(shape, corners, false, "straight");
    }

    CorpusElement pushed_corner(Shape shape, double t) {
        std::vector<Point> corners;
        for (int i = 0; i < n_corners(shape); ++i)
            corners.push_back(corner(shape, i));
        const int moved = pick(shape == Shape::pyramid ? 4 : n_corners(shape));
        // Neighbours: corners that share two faces.
        std::map<int, int> shared;
        for (int face = 0; face < n_faces(shape); ++face) {
            const auto list = face_corners(shape, face);
            if (std::find(list.begin(), list.end(), moved) == list.end())
                continue;
            for (const int other : list)
                shared[other] += 1;
        }
        Point mean{};
        for (const auto& [other, count] : shared)
            if (other != moved && count == 2)
                for (std::size_t k = 0; k < 3; ++k)
                    mean[k] += corners[static_cast<std::size_t>(other)][k] / 3;
        Point& v = corners[static_cast<std::size_t>(moved)];
        for (std::size_t k = 0; k < 3; ++k)
            v[k] += t * (mean[k] - v[k]);
        return make_straight(shape, corners, t > 1, "corner " + std::to_string(moved) + " pushed " + std::to_string(t));
    }

    CorpusElement twisted_tetrahedron() {
        return make(
            Shape::tetrahedron, 2,
            [](const Point& xi) {
                const double b = (1 + xi[0]) / 2, c = (1 + xi[1]) / 2, d = (1 + xi[2]) / 2;
                return Point{b, c, d + 0.6 * 4 * b * (1 - b - c - d)};
            },
            true, "twisted tetrahedron");
    }

    /** 1e-1 to 1e-6. */
    double small() { return std::pow(10.0, -3.5 + 2.5 * m_points.number()); }

private:
    int pick(int n) { return std::min(static_cast<int>((m_points.number() + 1) / 2 * n), n - 1); }

    Basis pick_basis(Shape shape) {
        if (shape == Shape::hexahedron)
            return std::array{Basis::modified, Basis::orthogonal, Basis::gll_lagrange,
                              Basis::gauss_lagrange}[static_cast<std::size_t>(pick(4))];
        if (shape == Shape::pyramid)
            return std::array{Basis::modified, Basis::orthogonal, Basis::tensor}[static_cast<std::size_t>(pick(3))];
        return pick(2) == 0 ? Basis::modified : Basis::orthogonal;
    }

    CorpusElement make_straight(Shape shape, const std::vector<Point>& corners, bool is_negative, const std::string& origin) {
        // Order of the corner modes: format.md, section 6.
        static const std::map<Shape, std::vector<std::size_t>> corner_of_mode{{Shape::hexahedron, {0, 1, 3, 2, 4, 5, 7, 6}},
                                                                              {Shape::prism, {0, 4, 3, 5, 1, 2}},
                                                                              {Shape::pyramid, {0, 4, 3, 1, 2}},
                                                                              {Shape::tetrahedron, {0, 3, 2, 1}}};
        const Space linear{shape, Basis::modified, {1, 1, 1}};
        std::array<std::vector<double>, 3> coefficients;
        for (const std::size_t index : corner_of_mode.at(shape))
            for (std::size_t k = 0; k < 3; ++k)
                coefficients[k].push_back(corners[index][k]);
        m_is_straight = true;
        CorpusElement element = make(
            shape, 1 + pick(2),
            [=](const Point& xi) {
                return Point{evaluate(linear, coefficients[0], xi), evaluate(linear, coefficients[1], xi),
                             evaluate(linear, coefficients[2], xi)};
            },
            is_negative, origin);
        m_is_straight = false;
        return element;
    }

    CorpusElement make(Shape shape, int order, const Mapping& mapping, bool is_negative, const std::string& origin) {
        const auto n = static_cast<std::uint32_t>(order);
        Basis basis = pick_basis(shape);
        // The straight pyramid is no polynomial.
        if (m_is_straight && shape == Shape::pyramid && basis == Basis::orthogonal)
            basis = Basis::modified;
        const Space space{shape, basis, {n, n, n}};
        // Rotations and stretches of 0.3 to 3, by the singular value decomposition of a random matrix.
        Eigen::Matrix3d random;
        for (double& entry : random.reshaped())
            entry = m_points.number();
        const Eigen::JacobiSVD<Eigen::Matrix3d> svd(random, Eigen::ComputeFullU | Eigen::ComputeFullV);
        Eigen::Vector3d stretch;
        for (double& entry : stretch)
            entry = std::pow(10.0, 0.5 * m_points.number());
        Eigen::Matrix3d affine = svd.matrixU() * stretch.asDiagonal() * svd.matrixV().transpose();
        if (affine.determinant() * m_sign < 0)
            affine.col(0) *= -1;
        const Eigen::Vector3d shift = 10 * Eigen::Vector3d(m_points.number(), m_points.number(), m_points.number());
        const auto placed = [&](const Point& xi) {
            const Point y = mapping(xi);
            const Eigen::Vector3d x = affine * Eigen::Vector3d(y[0], y[1], y[2]) + shift;
            return Point{x[0], x[1], x[2]};
        };
        return {space, fit_mapping(space, placed), is_negative, origin};
    }

    Points m_points;
    double m_sign = 1;
    bool m_is_straight = false;
};

/** Fit by least squares at points that determine the space. */
struct Fit {
    std::vector<Point> points;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> matrix;
};

const Fit& fit_of(const Space& space) {
    static std::map<std::tuple<Shape, Basis, std::array<std::uint32_t, 3>>, Fit> cache;
    auto [position, is_new] = cache.try_emplace({space.shape, space.basis, space.order});
    Fit& fit = position->second;
    if (!is_new)
        return fit;
    const std::size_t n = n_modes(space);
    const int side = static_cast<int>(*std::max_element(space.order.begin(), space.order.end())) + 2;
    // Chebyshev points of the cube, inside it.
    const auto coordinate = [side](int i) { return -std::cos(M_PI * (i + 0.5) / side); };
    for (int i = 0; i < side; ++i)
        for (int j = 0; j < side; ++j)
            for (int k = 0; k < side; ++k)
                fit.points.push_back(expand(space.shape, {coordinate(i), coordinate(j), coordinate(k)}));
    Eigen::MatrixXd values(fit.points.size(), n);
    std::vector<double> row(n);
    for (std::size_t i = 0; i < fit.points.size(); ++i) {
        evaluate_modes(space, fit.points[i], row);
        values.row(static_cast<Eigen::Index>(i)) = Eigen::Map<Eigen::RowVectorXd>(row.data(), static_cast<Eigen::Index>(n));
    }
    fit.matrix.compute(values);
    return fit;
}

} // namespace

std::vector<double> fit_mapping(const Space& space, const Mapping& mapping) {
    const Fit& fit = fit_of(space);
    Eigen::MatrixXd values(fit.points.size(), 3);
    for (std::size_t i = 0; i < fit.points.size(); ++i) {
        const Point x = mapping(fit.points[i]);
        values.row(static_cast<Eigen::Index>(i)) = Eigen::RowVector3d(x[0], x[1], x[2]);
    }
    const Eigen::MatrixXd solution = fit.matrix.solve(values);
    return {solution.data(), solution.data() + solution.size()};
}

double determinant_at(const Space& space, std::span<const double> coefficients, const Point& xi) {
    const std::size_t n = n_modes(space);
    std::vector<double> values(n), gradients(3 * n);
    evaluate_modes(space, xi, values, gradients);
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t mode = 0; mode < n; ++mode)
            for (std::size_t j = 0; j < 3; ++j)
                jacobian(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) +=
                    coefficients[i * n + mode] * gradients[3 * mode + j];
    return jacobian.determinant();
}

std::vector<CorpusElement> jacobian_corpus(unsigned seed, int n) {
    Maker maker(seed);
    std::vector<CorpusElement> result;
    for (const Shape shape : {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron})
        for (int i = 0; i < n; ++i)
            switch (i % 7) {
            case 0:
                result.push_back(maker.valid_bend(shape));
                break;
            case 1:
            case 2:
                result.push_back(maker.shear(shape, maker.small()));
                break;
            case 3:
            case 4:
                result.push_back(maker.shear(shape, -maker.small()));
                break;
            case 5:
                result.push_back(i % 2 == 0 ? maker.inverted(shape) : maker.straight(shape));
                break;
            default:
                if (shape == Shape::tetrahedron && i % 4 == 0)
                    result.push_back(maker.twisted_tetrahedron());
                else
                    result.push_back(maker.pushed_corner(shape, shape == Shape::tetrahedron && i % 2 == 0 ? 1 - maker.small()
                                                                                                          : 1 + maker.small()));
            }
    return result;
}

} // namespace elvis::native
