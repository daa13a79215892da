#include "enclosure.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace elvis::oracle {
namespace {

// Relative to the element's size. The conversion's rounding grows with the condition of the Bernstein basis, about 2^order *
// 1e-16 for the orders of meshes; this is far above, and costs nothing but a few more exact tests.
constexpr double conversion_margin = 1e-10;

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

std::vector<double> chebyshev_nodes(std::uint32_t order) {
    std::vector<double> nodes;
    for (std::uint32_t i = 0; i <= order; ++i)
        nodes.push_back(-std::cos(std::numbers::pi * (2.0 * i + 1) / (2.0 * order + 2)));
    return nodes;
}

// Matrix from values at Chebyshev nodes to Bernstein coefficients.
const Eigen::MatrixXd& to_bernstein(std::uint32_t order) {
    static std::map<std::uint32_t, Eigen::MatrixXd> cache;
    const auto known = cache.find(order);
    if (known != cache.end())
        return known->second;
    const std::vector<double> nodes = chebyshev_nodes(order);
    LongMatrix values(order + 1, order + 1);
    for (std::uint32_t i = 0; i <= order; ++i) {
        const long double u = (1.0L + nodes[i]) / 2;
        long double binomial = 1;
        for (std::uint32_t j = 0; j <= order; ++j) {
            values(i, j) =
                binomial * std::pow(u, static_cast<long double>(j)) * std::pow(1 - u, static_cast<long double>(order - j));
            binomial = binomial * (order - j) / (j + 1);
        }
    }
    return cache.emplace(order, LongMatrix(values.fullPivLu().inverse()).cast<double>()).first->second;
}

// Applies a matrix along one direction.
void apply(Patch& patch, std::size_t direction, const Eigen::MatrixXd& matrix) {
    const auto n = static_cast<std::size_t>(matrix.rows());
    const std::size_t stride =
        direction == 0 ? 1 : (direction == 1 ? patch.order[0] + 1 : (patch.order[0] + 1) * (patch.order[1] + 1));
    std::vector<Vector> line(n);
    for (std::size_t first = 0; first < patch.points.size(); ++first) {
        if ((first / stride) % n != 0)
            continue;
        for (std::size_t i = 0; i < n; ++i)
            line[i] = patch.points[first + i * stride];
        for (std::size_t i = 0; i < n; ++i) {
            Vector sum = Vector::Zero();
            for (std::size_t j = 0; j < n; ++j)
                sum += matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * line[j];
            patch.points[first + i * stride] = sum;
        }
    }
}

Patch make_patch(const Volume& volume, std::size_t element) {
    const native::Space& space = volume.geometry(element);
    Patch patch;
    patch.order = native::collapsed_order(space);
    std::array<std::vector<double>, 3> nodes;
    for (std::size_t d = 0; d < 3; ++d)
        nodes[d] = chebyshev_nodes(patch.order[d]);
    for (const double eta3 : nodes[2])
        for (const double eta2 : nodes[1])
            for (const double eta1 : nodes[0]) {
                const native::Point xi = native::expand(space.shape, {eta1, eta2, eta3});
                patch.points.push_back(volume.position(element, {xi[0], xi[1], xi[2]}));
            }
    for (std::size_t d = 0; d < 3; ++d)
        apply(patch, d, to_bernstein(patch.order[d]));
    return patch;
}

// Signs of the determinant at a lattice of the closed shape.
bool determinant_changes_sign(const Volume& volume, std::size_t element) {
    bool has_positive = false;
    bool has_negative = false;
    constexpr int n = 5;
    for (int k = 0; k <= n; ++k)
        for (int j = 0; j <= n; ++j)
            for (int i = 0; i <= n; ++i) {
                // Not quite to the collapsed end, where a pyramid's Jacobian need not exist.
                const native::Point eta{2.0 * i / n - 1, 2.0 * j / n - 1, std::min(2.0 * k / n - 1, 0.999)};
                const native::Point xi = native::expand(volume.shape(element), eta);
                Matrix jacobian;
                volume.position(element, {xi[0], xi[1], xi[2]}, &jacobian);
                const double determinant = jacobian.determinant();
                has_positive = has_positive || determinant > 0;
                has_negative = has_negative || !(determinant > 0);
            }
    return has_positive && has_negative;
}

} // namespace

std::array<Patch, 2> Patch::split(std::size_t direction) const {
    Patch low = *this;
    Patch high = *this;
    const std::size_t n = order[direction];
    const std::size_t stride = direction == 0 ? 1 : (direction == 1 ? order[0] + 1 : (order[0] + 1) * (order[1] + 1));
    for (std::size_t first = 0; first < points.size(); ++first) {
        if ((first / stride) % (n + 1) != 0)
            continue;
        // `high` holds the working triangle; its first entries become those of `low`.
        for (std::size_t level = 0; level <= n; ++level) {
            low.points[first + level * stride] = high.points[first];
            for (std::size_t i = 0; i + level < n; ++i)
                high.points[first + i * stride] =
                    0.5 * (high.points[first + i * stride] + high.points[first + (i + 1) * stride]);
        }
    }
    return {std::move(low), std::move(high)};
}

std::size_t Patch::longest_direction(const Matrix& to_reference) const {
    std::array<double, 3> length{};
    for (std::size_t k = 0; k <= order[2]; ++k)
        for (std::size_t j = 0; j <= order[1]; ++j)
            for (std::size_t i = 0; i <= order[0]; ++i) {
                const Vector& p = at(i, j, k);
                if (i > 0)
                    length[0] = std::max(length[0], order[0] * (to_reference * (p - at(i - 1, j, k))).norm());
                if (j > 0)
                    length[1] = std::max(length[1], order[1] * (to_reference * (p - at(i, j - 1, k))).norm());
                if (k > 0)
                    length[2] = std::max(length[2], order[2] * (to_reference * (p - at(i, j, k - 1))).norm());
            }
    return static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
}

bool Enclosure::may_contain(native::Shape shape, const Vector& x, double margin) const {
    const Vector reference = to_reference * (x - centre);
    const auto faces = face_constraints(shape);
    for (std::size_t face = 0; face < faces.size(); ++face)
        if (faces[face].normal.dot(reference) > slab[face] + margin)
            return false;
    return true;
}

std::vector<Enclosure> make_enclosures(const Volume& volume) {
    std::vector<Enclosure> enclosures(volume.n_elements());
    for (std::size_t element = 0; element < enclosures.size(); ++element) {
        Enclosure& e = enclosures[element];
        e.patch = make_patch(volume, element);
        e.lower = e.upper = e.patch.points.front();
        for (const Vector& p : e.patch.points) {
            e.lower = e.lower.cwiseMin(p);
            e.upper = e.upper.cwiseMax(p);
        }
        const double margin = conversion_margin * (e.upper - e.lower).norm();
        e.lower.array() -= margin;
        e.upper.array() += margin;
        e.is_folded = determinant_changes_sign(volume, element);

        Matrix jacobian;
        e.centre = volume.position(element, centre(volume.shape(element)), &jacobian);
        const double determinant = jacobian.determinant();
        e.to_reference = determinant == 0 || !std::isfinite(determinant) ? Matrix::Zero() : Matrix(jacobian.inverse());
        const auto faces = face_constraints(volume.shape(element));
        for (std::size_t face = 0; face < faces.size(); ++face) {
            e.slab[face] = -std::numeric_limits<double>::infinity();
            for (const Vector& p : e.patch.points)
                e.slab[face] = std::max(e.slab[face], faces[face].normal.dot(e.to_reference * (p - e.centre)));
            e.slab[face] += conversion_margin * (1 + std::abs(e.slab[face]));
        }
    }
    return enclosures;
}

} // namespace elvis::oracle
