/**
 * @file mode_tables.hpp
 * The factors of all modes of a space at one point.
 */
#pragma once

#include "../file/runs.hpp"

namespace elvis::native {

inline constexpr std::size_t row_size = 32; // max_order + 1, and one slot for the constant 1
static_assert(max_order + 2 <= row_size);
inline constexpr std::size_t n_plain_rows = max_order + 1;
// Second set: modified_b with power m - 1, m < 2 max_order.
inline constexpr std::size_t n_inner_rows = n_plain_rows + 2 * max_order;

// Outer and mid factors: slot 0 of row 0 is the constant 1, slot 1 + index the functions of row m.
template <std::size_t rows> struct OuterTable {
    double value[rows * row_size];
    double own[rows * row_size];
    double later[rows * row_size];
};

// Inner factors depend on one coordinate. `reduced` is value / t in modified and tensor pyramids and value elsewhere.
struct InnerTable {
    double value[n_inner_rows * row_size];
    double reduced[n_inner_rows * row_size];
    double slope[n_inner_rows * row_size];
};

struct ModeTables {
    OuterTable<1> outer;
    OuterTable<n_plain_rows> mid;
    InnerTable inner;
};

inline std::size_t row_of(const Factor& factor) {
    const bool collapsed =
        factor.kind == Kind::modified_b || factor.kind == Kind::orthogonal_b || factor.kind == Kind::orthogonal_c;
    return collapsed ? static_cast<std::size_t>(factor.m) : 0;
}

inline std::size_t outer_slot(const Factor& factor) {
    return factor.kind == Kind::one ? 0 : row_of(factor) * row_size + 1 + static_cast<std::size_t>(factor.index);
}

inline std::size_t inner_slot(const Space& space, const Factor& factor) {
    std::size_t row = row_of(factor);
    if (space.shape == Shape::pyramid && space.basis == Basis::modified && factor.power != factor.m)
        row += n_plain_rows;
    return row * row_size + static_cast<std::size_t>(factor.index);
}

void fill(ModeTables& tables, const Space& space, const Point& xi);

} // namespace elvis::native
