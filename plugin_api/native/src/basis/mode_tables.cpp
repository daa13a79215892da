/*
 * Values and gradients of the factors of modes.
 *
 * Collapsed shapes are evaluated without division. In the first direction of a triangle, prism or tetrahedron every mode holds
 * A_p(eta1) times at least t^p, where t is the product of l(eta) of the directions that collapse it, and t^p A_p(x/t) is a
 * polynomial in x = t eta1 and t, both linear in xi:
 *
 *                         x + t = 1 + xi_d      t                                (1 + xi_d) / t - 1 = eta_d
 *   triangle     d = 1                          (1 - xi2) / 2
 *   prism        d = 1                          (1 - xi3) / 2
 *   tetrahedron  d = 1                          (-xi2 - xi3) / 2
 *                d = 2                          (1 - xi3) / 2
 *   pyramid      d = 1, 2                       (1 - xi3) / 2
 *
 * Along xi_d itself dx = 1 and dt = 0 (derivative "own"); along every direction that collapses d, dx = 1/2 and dt = -1/2
 * (derivative "later").
 *
 * In modified and tensor pyramids A_p(eta1) A_q(eta2) comes with too low a power of t; there the factors are taken in eta,
 * d eta_d / d xi_d = 1/t and d eta_d / d xi3 = (1 + eta_d) / (2t), and 1/t is put on the inner factor ("reduced").
 */
#include "mode_tables.hpp"

#include "jacobi.hpp"
#include "quadrature.hpp"

#include <cmath>

namespace elvis::native {
namespace {

// Nodes of a Lagrange basis, with 1 / prod (z_i - z_j).
struct LagrangeNodes {
    std::array<double, row_size> points{};
    std::array<double, row_size> weights{};
};

using LagrangeTable = std::array<LagrangeNodes, row_size>; // by number of points

LagrangeTable make_lagrange_table(Kind kind) {
    LagrangeTable table;
    for (std::size_t n = 2; n <= max_order + 1; ++n) {
        std::array<long double, row_size> points{};
        if (kind == Kind::gll_lagrange)
            gauss_lobatto_legendre(std::span(points.data(), n));
        else
            gauss_legendre(std::span(points.data(), n));
        for (std::size_t i = 0; i < n; ++i) {
            long double product = 1;
            for (std::size_t j = 0; j < n; ++j)
                if (j != i)
                    product *= points[i] - points[j];
            table[n].points[i] = static_cast<double>(points[i]);
            table[n].weights[i] = static_cast<double>(1 / product);
        }
    }
    return table;
}

const LagrangeNodes& lagrange_nodes(Kind kind, std::size_t n) {
    static const LagrangeTable gll = make_lagrange_table(Kind::gll_lagrange);
    static const LagrangeTable gauss = make_lagrange_table(Kind::gauss_lagrange);
    return (kind == Kind::gll_lagrange ? gll : gauss)[n];
}

// Products of the linear factors from both ends: no division by z - z_i, so that nodes are no special case.
void lagrange(Kind kind, std::size_t n, double z, double* values, double* slopes) {
    const LagrangeNodes& nodes = lagrange_nodes(kind, n);
    double product = 1;
    double slope = 0;
    for (std::size_t i = 0; i < n; ++i) {
        values[i] = product;
        slopes[i] = slope;
        const double difference = z - nodes.points[i];
        slope = slope * difference + product;
        product *= difference;
    }
    product = 1;
    slope = 0;
    for (std::size_t i = n; i-- > 0;) {
        slopes[i] = (slopes[i] * product + values[i] * slope) * nodes.weights[i];
        values[i] *= product * nodes.weights[i];
        const double difference = z - nodes.points[i];
        slope = slope * difference + product;
        product *= difference;
    }
}

// All functions of an uncollapsed direction: values[0..order], slopes in z.
void uncollapsed(Kind kind, std::uint32_t order, double z, double* values, double* slopes) {
    const int n = static_cast<int>(order) + 1;
    if (kind == Kind::modified_a) {
        const double l = (1 - z) / 2;
        const double r = (1 + z) / 2;
        values[0] = l;
        slopes[0] = -0.5;
        values[1] = r;
        slopes[1] = 0.5;
        jacobi(1, 1, n - 2, z, values + 2, slopes + 2);
        for (int p = 2; p < n; ++p) {
            slopes[p] = l * r * slopes[p] - z / 2 * values[p];
            values[p] *= l * r;
        }
    } else if (kind == Kind::orthogonal_a) {
        jacobi(0, 0, n, z, values, slopes);
        for (int p = 0; p < n; ++p) {
            const double norm = std::sqrt(p + 0.5);
            values[p] *= norm;
            slopes[p] *= norm;
        }
    } else
        lagrange(kind, static_cast<std::size_t>(n), z, values, slopes);
}

// t^p A_p(x/t), and t A_0, for all p; low = (t - x)/2, high = (t + x)/2.
void scaled_uncollapsed(Kind kind, std::uint32_t order, double low, double high, double* values, double* own, double* later) {
    const int n = static_cast<int>(order) + 1;
    const double x = high - low;
    const double t = high + low;
    if (kind == Kind::modified_a) {
        values[0] = low;
        own[0] = later[0] = -0.5;
        values[1] = high;
        own[1] = 0.5;
        later[1] = 0;
        scaled_jacobi(1, 1, n - 2, x, t, values + 2, own + 2, later + 2);
        for (int p = 2; p < n; ++p) {
            own[p] = low * high * own[p] + (low - high) / 2 * values[p];
            later[p] = low * high * later[p] - high / 2 * values[p];
            values[p] *= low * high;
        }
    } else {
        scaled_jacobi(0, 0, n, x, t, values, own, later);
        for (int p = 0; p < n; ++p) {
            const double norm = std::sqrt(p + 0.5);
            values[p] *= norm;
            own[p] *= norm;
            later[p] *= norm;
        }
    }
}

double orthogonal_norm(Kind kind, int m, int index) { return std::sqrt(m + index + (kind == Kind::orthogonal_b ? 1.0 : 1.5)); }

int orthogonal_a_of(Kind kind, int m) { return 2 * m + (kind == Kind::orthogonal_b ? 1 : 2); }

// One row of modified_b, orthogonal_b or orthogonal_c without powers of l.
void collapsed_row(Kind kind, int m, int count, double z, double* values, double* slopes) {
    if (kind == Kind::modified_b) {
        const double r = (1 + z) / 2;
        values[0] = 1;
        slopes[0] = 0;
        jacobi(2 * m - 1, 1, count - 1, z, values + 1, slopes + 1);
        for (int q = 1; q < count; ++q) {
            slopes[q] = r * slopes[q] + values[q] / 2;
            values[q] *= r;
        }
    } else {
        jacobi(orthogonal_a_of(kind, m), 0, count, z, values, slopes);
        for (int q = 0; q < count; ++q) {
            const double norm = orthogonal_norm(kind, m, q);
            values[q] *= norm;
            slopes[q] *= norm;
        }
    }
}

// The same, times t^index.
void scaled_collapsed_row(Kind kind, int m, int count, double low, double high, double* values, double* own, double* later) {
    const double x = high - low;
    const double t = high + low;
    if (kind == Kind::modified_b) {
        values[0] = 1;
        own[0] = later[0] = 0;
        scaled_jacobi(2 * m - 1, 1, count - 1, x, t, values + 1, own + 1, later + 1);
        for (int q = 1; q < count; ++q) {
            own[q] = high * own[q] + values[q] / 2;
            later[q] *= high;
            values[q] *= high;
        }
    } else {
        scaled_jacobi(orthogonal_a_of(kind, m), 0, count, x, t, values, own, later);
        for (int q = 0; q < count; ++q) {
            const double norm = orthogonal_norm(kind, m, q);
            values[q] *= norm;
            own[q] *= norm;
            later[q] *= norm;
        }
    }
}

template <std::size_t rows> void fill_uncollapsed(OuterTable<rows>& table, Kind kind, std::uint32_t order, double z) {
    uncollapsed(kind, order, z, table.value + 1, table.own + 1);
    std::fill_n(table.later + 1, order + 1, 0.0);
}

// Functions of eta_d for rational pyramids; derivatives still to be divided by t.
template <std::size_t rows> void fill_rational(OuterTable<rows>& table, Kind kind, std::uint32_t order, double eta) {
    uncollapsed(kind, order, eta, table.value + 1, table.own + 1);
    for (std::size_t p = 1; p <= order + 1; ++p)
        table.later[p] = table.own[p] * (1 + eta) / 2;
}

template <std::size_t rows> void fill_scaled(OuterTable<rows>& table, Kind kind, std::uint32_t order, double low, double high) {
    scaled_uncollapsed(kind, order, low, high, table.value + 1, table.own + 1, table.later + 1);
}

// Inner rows of triangles, prisms, tetrahedra (degrees up to order - m) and orthogonal pyramids.
void fill_inner_rows(InnerTable& table, Kind kind, int order, int last_row, double z) {
    for (int m = kind == Kind::modified_b ? 1 : 0; m <= last_row; ++m) {
        const std::size_t row = static_cast<std::size_t>(m) * row_size;
        int count = last_row > order ? order - (m + 1) / 2 + 1 : order - m + 1; // pyramid: max(p, q) >= (p + q) / 2
        // The mode of the collapsed vertex or edge has index 1 in row 1, in spaces of order 1 too.
        if (kind == Kind::modified_b && m == 1)
            count = std::max(count, 2);
        collapsed_row(kind, m, count, z, table.value + row, table.slope + row);
        std::copy_n(table.value + row, count, table.reduced + row);
    }
}

// Inner rows of modified pyramids: t^m times row m, and t^(m-1) times row m in the second set.
void fill_modified_pyramid(InnerTable& table, int order, double xi3) {
    const double t = (1 - xi3) / 2;
    double values[row_size];
    double slopes[row_size];
    double low_power = 1;   // t^(m-1)
    double lower_power = 0; // t^(m-2); the only function with m = 1 in the second set is that of the apex, which needs none
    for (int m = 1; m < std::max(2 * order, 2); ++m) {
        const int count = order - std::min(m, order) + 1;
        const int second_count = m == 1 ? std::min(order, 1) + 1 : order - (m + 2) / 2 + 1; // max(p, q) >= (m + 1) / 2
        collapsed_row(Kind::modified_b, m, std::max(count, second_count), xi3, values, slopes);
        const double power = low_power * t;
        const auto fill = [&](std::size_t row, int n, int exponent, double high, double low) {
            for (int i = 0; i < n; ++i) {
                const std::size_t slot = row * row_size + static_cast<std::size_t>(i);
                table.value[slot] = high * values[i];
                table.reduced[slot] = low * values[i];
                table.slope[slot] = high * slopes[i] - 0.5 * exponent * low * values[i];
            }
        };
        if (m <= order)
            fill(static_cast<std::size_t>(m), count, m, power, low_power);
        fill(n_plain_rows + static_cast<std::size_t>(m), second_count, m - 1, low_power, lower_power);
        lower_power = low_power;
        low_power = power;
    }
}

void fill_tensor_pyramid(InnerTable& table, std::uint32_t order, double xi3) {
    uncollapsed(Kind::modified_a, order, xi3, table.value, table.slope);
    const double t = (1 - xi3) / 2;
    // At t = 0, A_r / t = A_r(1) / t - 2 A_r'(1) + O(t); the pole belongs to A_1 only and cancels (space.hpp).
    for (std::size_t r = 0; r <= order; ++r)
        table.reduced[r] = t == 0 ? -2 * table.slope[r] : table.value[r] / t;
}

} // namespace

void fill(ModeTables& tables, const Space& space, const Point& xi) {
    const bool modified = space.basis == Basis::modified;
    const Kind kind = uncollapsed_kind(space.basis);
    const Kind b = modified ? Kind::modified_b : Kind::orthogonal_b;
    const Kind c = modified ? Kind::modified_b : Kind::orthogonal_c;
    const auto& order = space.order;
    const int n2 = static_cast<int>(order[1]);
    const int n3 = static_cast<int>(order[2]);
    tables.outer.value[0] = tables.mid.value[0] = 1;
    tables.outer.own[0] = tables.outer.later[0] = tables.mid.own[0] = tables.mid.later[0] = 0;
    switch (space.shape) {
    case Shape::hexahedron:
    case Shape::quadrilateral: {
        const bool cube = space.shape == Shape::hexahedron;
        uncollapsed(kind, order[0], xi[0], tables.inner.value, tables.inner.slope);
        std::copy_n(tables.inner.value, order[0] + 1, tables.inner.reduced);
        fill_uncollapsed(tables.outer, kind, order[cube ? 2 : 1], xi[cube ? 2 : 1]);
        if (cube)
            fill_uncollapsed(tables.mid, kind, order[1], xi[1]);
        break;
    }
    case Shape::triangle:
        fill_scaled(tables.outer, kind, order[0], (-xi[0] - xi[1]) / 2, (1 + xi[0]) / 2);
        fill_inner_rows(tables.inner, b, n2, n2, xi[1]);
        break;
    case Shape::prism:
        fill_scaled(tables.outer, kind, order[0], (-xi[0] - xi[2]) / 2, (1 + xi[0]) / 2);
        fill_uncollapsed(tables.mid, kind, order[1], xi[1]);
        fill_inner_rows(tables.inner, b, n3, n3, xi[2]);
        break;
    case Shape::pyramid:
        if (space.basis == Basis::orthogonal) {
            fill_scaled(tables.outer, kind, order[0], (-xi[0] - xi[2]) / 2, (1 + xi[0]) / 2);
            fill_scaled(tables.mid, kind, order[1], (-xi[1] - xi[2]) / 2, (1 + xi[1]) / 2);
            fill_inner_rows(tables.inner, c, n3, 2 * n3, xi[2]);
        } else {
            const Point eta = collapse(Shape::pyramid, xi);
            fill_rational(tables.outer, kind, order[0], eta[0]);
            fill_rational(tables.mid, kind, order[1], eta[1]);
            if (modified)
                fill_modified_pyramid(tables.inner, n3, xi[2]);
            else
                fill_tensor_pyramid(tables.inner, order[2], xi[2]);
        }
        break;
    case Shape::tetrahedron:
        fill_scaled(tables.outer, kind, order[0], (-1 - xi[0] - xi[1] - xi[2]) / 2, (1 + xi[0]) / 2);
        for (int m = modified ? 1 : 0; m <= n2; ++m) {
            const std::size_t row = static_cast<std::size_t>(m) * row_size + 1;
            // Index 1 of row 1 belongs to the collapsed edge, in spaces of order 1 too.
            const int count = modified && m == 1 ? std::max(n2, 2) : n2 - m + 1;
            scaled_collapsed_row(b, m, count, (-xi[1] - xi[2]) / 2, (1 + xi[1]) / 2, tables.mid.value + row,
                                 tables.mid.own + row, tables.mid.later + row);
        }
        fill_inner_rows(tables.inner, c, n3, n3, xi[2]);
        break;
    }
}

} // namespace elvis::native
