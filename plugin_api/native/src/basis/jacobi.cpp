#include "jacobi.hpp"

#include <array>
#include <cassert>
#include <memory>

namespace elvis::native {
namespace {

constexpr std::size_t n_degrees = max_order + 1;
using Row = std::array<Recurrence, n_degrees>;
using Table = std::array<std::array<Row, max_jacobi_a + 1>, 2>;

std::unique_ptr<const Table> make_table() {
    auto table = std::make_unique<Table>();
    for (std::size_t b = 0; b < 2; ++b)
        for (std::size_t a = 0; a <= max_jacobi_a; ++a) {
            Row& row = (*table)[b][a];
            const auto alpha = static_cast<double>(a);
            const auto beta = static_cast<double>(b);
            row[1] = {(alpha - beta) / 2, (alpha + beta + 2) / 2, 0};
            for (std::size_t n = 2; n < n_degrees; ++n) {
                const auto k = static_cast<double>(n);
                const double s = 2 * k + alpha + beta;
                // All products are integers below 2^53, hence exact; each entry has one rounding.
                const double divisor = 2 * k * (k + alpha + beta) * (s - 2);
                row[n].a = (s - 1) * (alpha * alpha - beta * beta) / divisor;
                row[n].b = (s - 2) * (s - 1) * s / divisor;
                row[n].c = 2 * (k + alpha - 1) * (k + beta - 1) * s / divisor;
            }
        }
    return table;
}

} // namespace

const Recurrence* jacobi_recurrence(int a, int b) {
    static const std::unique_ptr<const Table> table = make_table();
    assert(a >= 0 && a <= max_jacobi_a && (b == 0 || b == 1));
    return (*table)[static_cast<std::size_t>(b)][static_cast<std::size_t>(a)].data();
}

void jacobi(int a, int b, int count, double z, double* values, double* slopes) {
    if (count <= 0)
        return;
    values[0] = 1;
    slopes[0] = 0;
    if (count == 1)
        return;
    const Recurrence* rows = jacobi_recurrence(a, b);
    values[1] = rows[1].a + rows[1].b * z;
    slopes[1] = rows[1].b;
    for (int n = 2; n < count; ++n) {
        const Recurrence& row = rows[n];
        const double factor = row.a + row.b * z;
        values[n] = factor * values[n - 1] - row.c * values[n - 2];
        slopes[n] = row.b * values[n - 1] + factor * slopes[n - 1] - row.c * slopes[n - 2];
    }
}

void scaled_jacobi(int a, int b, int count, double x, double t, double* values, double* own, double* later) {
    if (count <= 0)
        return;
    values[0] = 1;
    own[0] = later[0] = 0;
    if (count == 1)
        return;
    const Recurrence* rows = jacobi_recurrence(a, b);
    values[1] = rows[1].a * t + rows[1].b * x;
    own[1] = rows[1].b;
    later[1] = (rows[1].b - rows[1].a) / 2;
    for (int n = 2; n < count; ++n) {
        const Recurrence& row = rows[n];
        const double factor = row.a * t + row.b * x;
        const double square = row.c * t * t;
        values[n] = factor * values[n - 1] - square * values[n - 2];
        own[n] = row.b * values[n - 1] + factor * own[n - 1] - square * own[n - 2];
        later[n] =
            (row.b - row.a) / 2 * values[n - 1] + factor * later[n - 1] + row.c * t * values[n - 2] - square * later[n - 2];
    }
}

} // namespace elvis::native
