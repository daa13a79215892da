#include "pyramid_bounds.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace elvis::native {
namespace {

constexpr std::size_t towards_apex = 2;

double largest(const DerivativeForms::Column& f, const double* forms) {
    double most = 0;
    for (std::size_t i = 0; i < product(f.sizes); ++i)
        most = std::max(most, std::abs(forms[f.offset + i]));
    return most;
}

/** Of df/deta in a direction: (n/2) (b_{k+1} - b_k); towards the apex times t, which raises the degree by one. */
double steepest(const DerivativeForms::Column& f, const double* forms, std::size_t direction) {
    const std::size_t place = storage_places(Shape::pyramid)[direction];
    const std::size_t degree = f.sizes[place] - 1;
    std::size_t stride = 1;
    for (std::size_t faster = place + 1; faster < 3; ++faster)
        stride *= f.sizes[faster];
    double most = 0;
    for (std::size_t i = 0; i < product(f.sizes); ++i) {
        const std::size_t k = i / stride % f.sizes[place];
        if (k == degree)
            continue;
        const double share = direction == towards_apex ? double(degree - k) / double(degree) : 1;
        most = std::max(most, share * std::abs(forms[f.offset + i + stride] - forms[f.offset + i]));
    }
    return 0.5 * double(degree) * most;
}

} // namespace

bool PyramidBounds::has_bounds(const Space& space) {
    return space.shape == Shape::pyramid && space.basis != Basis::tensor && space.order[0] > 0;
}

DerivativeBound PyramidBounds::bound(std::span<const double> coefficients) const {
    assert(coefficients.size() == m_forms.n_modes());
    thread_local std::vector<double> forms, workspace;
    forms.resize(m_forms.size());
    workspace.resize(m_forms.workspace_size());
    double magnitude = 0;
    m_forms.evaluate<1>(coefficients.data(), workspace.data(), forms.data(), &magnitude);
    const auto& f = m_forms.columns();
    const auto along = [&](std::size_t direction, std::size_t column) { return steepest(f[column], forms.data(), direction); };
    // t f_13 and t f_23 count twice, and once more in t f_33.
    const double second = along(0, 0) + along(1, 1) + 2 * std::min(along(1, 0), along(0, 1)) + 3 * (along(0, 2) + along(1, 2)) +
                          along(towards_apex, 2);
    double first = 0, error = 0, degree = 0;
    for (const DerivativeForms::Column& column : f) {
        first += largest(column, forms.data());
        // Of a coefficient, and of the few operations with it here.
        error += magnitude * (column.error + 8 * std::numeric_limits<double>::epsilon() * column.bound);
        degree = std::max(degree, double(*std::max_element(column.sizes.begin(), column.sizes.end())));
    }
    // A difference has two coefficients, and no column takes part in more than seven.
    return {first + error, second + 7 * degree * error};
}

} // namespace elvis::native
