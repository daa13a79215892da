#include <core/volume/element/chebyshev.hpp>

#include <cstddef>

namespace elvis {

std::vector<double> chebyshev_values(int order, double x) {
    std::vector<double> values{1.0};
    for (int n = 1; n <= order; ++n) {
        const double before = n == 1 ? 0.0 : values[static_cast<std::size_t>(n - 2)];
        values.push_back((n == 1 ? x : 2 * x) * values.back() - before);
    }
    return values;
}

std::vector<double> chebyshev_on_interval(int order, double middle, double half) {
    // T_{n+1} = 2 y T_n - T_{n-1} with y = middle + half a, and a T_m = (T_{m+1} + T_{|m-1|}) / 2.
    const auto size = static_cast<std::size_t>(order + 1);
    std::vector<double> s(size * size, 0.0);
    s[0] = 1;
    for (std::size_t n = 0; n + 1 < size; ++n) {
        const double factor = n == 0 ? 1 : 2;
        double* next = &s[(n + 1) * size];
        for (std::size_t m = 0; m <= n; ++m) {
            const double c = factor * s[n * size + m];
            next[m] += middle * c;
            next[m + 1] += (m == 0 ? 1.0 : 0.5) * half * c;
            if (m > 0) {
                next[m - 1] += 0.5 * half * c;
            }
        }
        for (std::size_t m = 0; n > 0 && m < n; ++m) {
            next[m] -= s[(n - 1) * size + m];
        }
    }
    return s;
}

} // namespace elvis
