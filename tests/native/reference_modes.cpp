#include "reference_modes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace elvis::native {
namespace {

using Real = long double;

Real binomial(int n, int k) {
    Real result = 1;
    for (int i = 1; i <= k; ++i)
        result = result * static_cast<Real>(n - k + i) / static_cast<Real>(i);
    return result;
}

Real l(Real z) { return (1 - z) / 2; }
Real r(Real z) { return (1 + z) / 2; }

Real modified_a(int p, Real z) {
    if (p == 0)
        return l(z);
    if (p == 1)
        return r(z);
    return l(z) * r(z) * reference_jacobi(p - 2, 1, 1, z);
}

Real modified_b(int p, int q, Real z) {
    if (p == 0)
        return modified_a(q, z);
    if (q == 0)
        return std::pow(l(z), static_cast<Real>(p));
    return std::pow(l(z), static_cast<Real>(p)) * r(z) * reference_jacobi(q - 1, 2 * p - 1, 1, z);
}

Real modified_pyramid_c(int p, int q, int k, Real z) {
    if (p < 2 || q < 2)
        return modified_b(std::max(p, q), k, z);
    const Real power = std::pow(l(z), static_cast<Real>(p + q - 2));
    return k == 0 ? power : power * r(z) * reference_jacobi(k - 1, 2 * p + 2 * q - 3, 1, z);
}

Real orthogonal_a(int p, Real z) { return std::sqrt((2 * p + 1) / 2.0L) * reference_jacobi(p, 0, 0, z); }

Real orthogonal_b(int p, int q, Real z) {
    return std::sqrt(p + q + 1.0L) * std::pow(l(z), static_cast<Real>(p)) * reference_jacobi(q, 2 * p + 1, 0, z);
}

Real orthogonal_c(int m, int k, Real z) {
    return std::sqrt(m + k + 1.5L) * std::pow(l(z), static_cast<Real>(m)) * reference_jacobi(k, 2 * m + 2, 0, z);
}

std::vector<Real> zeros(int n, int a, int b) {
    std::vector<Real> result;
    const int steps = 1000; // zeros of degree 31 lie 0.005 apart at least
    for (int i = 0; i < steps; ++i) {
        Real low = -1 + 2.0L * static_cast<Real>(i) / steps - 1e-7L;
        Real high = -1 + 2.0L * static_cast<Real>(i + 1) / steps - 1e-7L;
        if (reference_jacobi(n, a, b, low) * reference_jacobi(n, a, b, high) > 0)
            continue;
        for (int k = 0; k < 80; ++k) {
            const Real middle = (low + high) / 2;
            (reference_jacobi(n, a, b, low) * reference_jacobi(n, a, b, middle) > 0 ? low : high) = middle;
        }
        result.push_back((low + high) / 2);
    }
    return result;
}

Real lagrange(const std::vector<Real>& nodes, int i, Real z) {
    Real value = 1;
    for (std::size_t j = 0; j < nodes.size(); ++j)
        if (j != static_cast<std::size_t>(i))
            value *= (z - nodes[j]) / (nodes[static_cast<std::size_t>(i)] - nodes[j]);
    return value;
}

// Ascending; kept, because bisection is slow.
const std::vector<Real>& nodes_of(Basis basis, std::uint32_t order) {
    static std::map<std::pair<Basis, std::uint32_t>, std::vector<Real>> known;
    std::vector<Real>& nodes = known[{basis, order}];
    if (!nodes.empty())
        return nodes;
    const int n = static_cast<int>(order);
    if (basis == Basis::gauss_lagrange) {
        nodes = zeros(n + 1, 0, 0);
    } else {
        nodes = zeros(n - 1, 1, 1);
        nodes.insert(nodes.begin(), -1);
        nodes.push_back(1);
    }
    return nodes;
}

} // namespace

long double reference_jacobi(int n, int a, int b, long double z) {
    Real sum = 0;
    for (int s = 0; s <= n; ++s)
        sum += binomial(n + a, n - s) * binomial(n + b, s) * std::pow((z - 1) / 2, static_cast<Real>(s)) *
               std::pow((z + 1) / 2, static_cast<Real>(n - s));
    return sum;
}

std::vector<ModeIndex> reference_indices(const Space& space) {
    const int a = static_cast<int>(space.order[0]) + 1;
    const int b = static_cast<int>(space.order[1]) + 1;
    const int c = static_cast<int>(space.order[2]) + 1;
    std::vector<ModeIndex> result;
    if (space.shape == Shape::hexahedron || space.shape == Shape::quadrilateral) {
        for (int k = 0; k < c; ++k)
            for (int q = 0; q < b; ++q)
                for (int p = 0; p < a; ++p)
                    result.push_back({p, q, k});
        return result;
    }
    for (int p = 0; p < a; ++p)
        for (int q = 0; q < b; ++q)
            for (int k = 0; k < c; ++k) {
                bool exists = true;
                if (space.shape == Shape::triangle)
                    exists = q < b - p;
                else if (space.shape == Shape::prism)
                    exists = k < c - p;
                else if (space.shape == Shape::tetrahedron)
                    exists = q < b - p && k < c - p - q;
                else if (space.basis != Basis::tensor)
                    exists = k < c - std::max(p, q);
                if (exists)
                    result.push_back({p, q, k});
            }
    return result;
}

std::vector<long double> reference_modes(const Space& space, const Point& eta) {
    const Real x = eta[0];
    const Real y = eta[1];
    const Real z = eta[2];
    const bool constant = space.order == std::array<std::uint32_t, 3>{};
    const bool lagrangian = space.basis == Basis::gll_lagrange || space.basis == Basis::gauss_lagrange;
    std::array<std::vector<Real>, 3> nodes;
    if (lagrangian && !constant)
        for (std::size_t d = 0; d < 3; ++d)
            if (space.order[d] > 0)
                nodes[d] = nodes_of(space.basis, space.order[d]);
    const auto factor = [&](std::size_t direction, int index, Real value) {
        if (lagrangian)
            return lagrange(nodes[direction], index, value);
        return space.basis == Basis::orthogonal ? orthogonal_a(index, value) : modified_a(index, value);
    };
    const bool modified = space.basis == Basis::modified;
    std::vector<Real> result;
    for (const auto& [p, q, k] : reference_indices(space)) {
        if (constant) {
            result.push_back(1);
            continue;
        }
        switch (space.shape) {
        case Shape::quadrilateral:
            result.push_back(factor(0, p, x) * factor(1, q, y));
            break;
        case Shape::hexahedron:
            result.push_back(factor(0, p, x) * factor(1, q, y) * factor(2, k, z));
            break;
        case Shape::triangle:
            if (!modified)
                result.push_back(orthogonal_a(p, x) * orthogonal_b(p, q, y));
            else
                result.push_back((p == 0 && q == 1 ? 1 : modified_a(p, x)) * modified_b(p, q, y));
            break;
        case Shape::prism:
            if (!modified)
                result.push_back(orthogonal_a(p, x) * orthogonal_a(q, y) * orthogonal_b(p, k, z));
            else
                result.push_back((p == 0 && k == 1 ? 1 : modified_a(p, x)) * modified_a(q, y) * modified_b(p, k, z));
            break;
        case Shape::tetrahedron:
            if (!modified)
                result.push_back(orthogonal_a(p, x) * orthogonal_b(p, q, y) * orthogonal_c(p + q, k, z));
            else if (p == 0 && q == 0 && k == 1)
                result.push_back(r(z));
            else
                result.push_back((p == 0 && q == 1 ? 1 : modified_a(p, x)) * modified_b(p, q, y) * modified_b(p + q, k, z));
            break;
        case Shape::pyramid:
            if (space.basis == Basis::tensor)
                result.push_back(modified_a(p, x) * modified_a(q, y) * modified_a(k, z));
            else if (!modified)
                result.push_back(orthogonal_a(p, x) * orthogonal_a(q, y) * orthogonal_c(p + q, k, z));
            else if (p == 0 && q == 0 && k == 1)
                result.push_back(r(z));
            else
                result.push_back(modified_a(p, x) * modified_a(q, y) * modified_pyramid_c(p, q, k, z));
            break;
        }
    }
    return result;
}

} // namespace elvis::native
