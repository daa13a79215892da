#include <elvis/native/device_space.hpp>

#include "jets.hpp"

#include <algorithm>
#include <cmath>

namespace elvis::native::device {
namespace {

using native::Basis;
using native::Shape;

double chebyshev(int n, double z) { return std::cos(n * std::acos(std::clamp(z, -1.0, 1.0))); }

} // namespace

DeviceSpace::DeviceSpace(const native::Space& space)
    : shape(space.shape), basis(space.basis), p_max(static_cast<int>(space.order[0])), q_max(static_cast<int>(space.order[1])),
      r_max(static_cast<int>(space.order[2])) {
    if (shape == Shape::quadrilateral)
        shape = Shape::hexahedron;
    if (shape == Shape::triangle) {
        shape = Shape::prism;
        std::swap(q_max, r_max);
    }
}

int DeviceSpace::n_q(int p) const { return shape == Shape::tetrahedron ? std::max(q_max - p + 1, 0) : q_max + 1; }

int DeviceSpace::n_r(int p, int q) const {
    switch (shape) {
    case Shape::prism:
        return std::max(r_max - p + 1, 0);
    case Shape::tetrahedron:
        return std::max(r_max - p - q + 1, 0);
    case Shape::pyramid:
        return basis == Basis::tensor ? r_max + 1 : r_max - std::max(p, q) + 1;
    default:
        return r_max + 1;
    }
}

bool DeviceSpace::has_apex(int p, int q) const { return shape == Shape::pyramid && (basis == Basis::tensor || p + q == 0); }

int DeviceSpace::exponent(int p, int q) const {
    if (basis == Basis::tensor || p + q == 0)
        return 1;
    if (basis == Basis::orthogonal)
        return p + q;
    return std::min(p, q) >= 2 ? p + q - 2 : std::max(p, q);
}

double DeviceSpace::a(int p, double eta1) const {
    if (shape == Shape::hexahedron)
        return chebyshev(p, eta1);
    if (has_inner_functions() && p >= 2)
        return (1 - eta1) * (1 + eta1) / 4 * jacobi_11(p - 2, eta1);
    return jacobi(0, p, eta1);
}

double DeviceSpace::b(int p, int q, double eta2) const {
    if (shape == Shape::prism)
        return chebyshev(q, eta2);
    if (shape == Shape::tetrahedron)
        return power((1 - eta2) / 2, p) * jacobi(2 * p + 1, q, eta2);
    return a(q, eta2);
}

double DeviceSpace::c(int p, int q, int r, double eta3) const {
    const double t = (1 - eta3) / 2;
    switch (shape) {
    case Shape::prism:
        return power(t, p) * jacobi(2 * p + 1, r, eta3);
    case Shape::tetrahedron:
        return power(t, p + q) * jacobi(2 * (p + q) + 2, r, eta3);
    case Shape::pyramid: {
        const bool apex = has_apex(p, q);
        if (apex && r == 0)
            return 1;
        const int e = exponent(p, q);
        return power(t, e) * jacobi(2 * e + 2, apex ? r - 1 : r, eta3);
    }
    default:
        return chebyshev(r, eta3);
    }
}

std::size_t DeviceSpace::n_slabs() const {
    switch (shape) {
    case Shape::hexahedron:
        return static_cast<std::size_t>(r_max) + 1;
    case Shape::prism:
        return static_cast<std::size_t>(q_max) + 1;
    case Shape::pyramid:
        return basis == Basis::tensor ? static_cast<std::size_t>(p_max) + 1 : 1;
    default:
        return 1;
    }
}

std::size_t DeviceSpace::slab_size() const {
    std::size_t count = 0;
    for (int p = 0; p <= p_max; ++p)
        for (int q = 0; q < n_q(p); ++q)
            count += static_cast<std::size_t>(n_r(p, q));
    return count / n_slabs();
}

} // namespace elvis::native::device
