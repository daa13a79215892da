// Values and gradients of modes and of their sums: products of factors, from tables.
#include "evaluate.hpp"

#include "mode_tables.hpp"

#include <algorithm>
#include <cassert>

namespace elvis::native {
namespace {

// Values and derivatives of outer * mid, to be multiplied by inner sums.
struct Product {
    double value;
    double along_outer, along_mid, along_inner;
};

inline Product product(const ModeTables& tables, const Run& run, bool outer_bends_mid) {
    const std::size_t i = outer_slot(run.outer);
    const std::size_t j = outer_slot(run.mid);
    const OuterTable<1>& a = tables.outer;
    const OuterTable<n_plain_rows>& b = tables.mid;
    return {a.value[i] * b.value[j], a.own[i] * b.value[j],
            a.value[i] * b.own[j] + (outer_bends_mid ? a.later[i] * b.value[j] : 0.0),
            a.later[i] * b.value[j] + a.value[i] * b.later[j]};
}

// Of one run of one function: sums of coefficients times the inner factors.
struct InnerSums {
    double value = 0, reduced = 0, slope = 0;
};

InnerSums inner_sums(const InnerTable& table, bool has_reduced, std::size_t slot, const double* coefficients,
                     std::size_t count) {
    InnerSums sums;
    for (std::size_t i = 0; i < count; ++i) {
        sums.value += coefficients[i] * table.value[slot + i];
        sums.slope += coefficients[i] * table.slope[slot + i];
    }
    sums.reduced = sums.value;
    if (has_reduced) {
        sums.reduced = 0;
        for (std::size_t i = 0; i < count; ++i)
            sums.reduced += coefficients[i] * table.reduced[slot + i];
    }
    return sums;
}

} // namespace

void evaluate_together(const Space& space, std::span<const double> coefficients, const Point& xi, std::span<double> values,
                       std::span<double> gradients) {
    const std::size_t n = coefficients.size() / values.size();
    assert(gradients.empty() || gradients.size() == 3 * values.size());
    std::ranges::fill(gradients, 0);
    if (is_constant(space)) {
        std::ranges::copy(coefficients, values.begin());
        return;
    }
    std::ranges::fill(values, 0);
    ModeTables tables;
    fill(tables, space, xi);
    const Directions axis = directions(space.shape);
    const bool outer_bends_mid = space.shape == Shape::tetrahedron, has_reduced = space.shape == Shape::pyramid;
    for_each_run(space, [&](const Run& run) {
        const Product factor = product(tables, run, outer_bends_mid);
        const std::size_t slot = inner_slot(space, run.inner);
        for (std::size_t function = 0; function < values.size(); ++function) {
            const InnerSums sums = inner_sums(tables.inner, has_reduced, slot, coefficients.data() + function * n + run.first,
                                              static_cast<std::size_t>(run.count));
            values[function] += factor.value * sums.value;
            if (!gradients.empty()) {
                double* const gradient = gradients.data() + 3 * function;
                gradient[axis.outer] += factor.along_outer * sums.reduced;
                gradient[axis.mid] += factor.along_mid * sums.reduced;
                gradient[axis.inner] += factor.along_inner * sums.reduced + factor.value * sums.slope;
            }
        }
    });
}

void evaluate_modes(const Space& space, const Point& xi, std::span<double> values) {
    assert(values.size() == n_modes(space));
    if (is_constant(space)) {
        values[0] = 1;
        return;
    }
    ModeTables tables;
    fill(tables, space, xi);
    for_each_run(space, [&](const Run& run) {
        const double factor = tables.outer.value[outer_slot(run.outer)] * tables.mid.value[outer_slot(run.mid)];
        const double* inner = tables.inner.value + inner_slot(space, run.inner);
        for (std::size_t i = 0; i < static_cast<std::size_t>(run.count); ++i)
            values[run.first + i] = factor * inner[i];
    });
}

void evaluate_modes(const Space& space, const Point& xi, std::span<double> values, std::span<double> gradients) {
    assert(values.size() == n_modes(space) && gradients.size() == 3 * values.size());
    if (is_constant(space)) {
        values[0] = 1;
        gradients[0] = gradients[1] = gradients[2] = 0;
        return;
    }
    ModeTables tables;
    fill(tables, space, xi);
    const Directions axis = directions(space.shape);
    const bool outer_bends_mid = space.shape == Shape::tetrahedron;
    for_each_run(space, [&](const Run& run) {
        const Product factor = product(tables, run, outer_bends_mid);
        const std::size_t slot = inner_slot(space, run.inner);
        for (std::size_t i = 0; i < static_cast<std::size_t>(run.count); ++i) {
            const double reduced = tables.inner.reduced[slot + i];
            double* gradient = gradients.data() + 3 * (run.first + i);
            values[run.first + i] = factor.value * tables.inner.value[slot + i];
            gradient[axis.outer] = factor.along_outer * reduced;
            gradient[axis.mid] = factor.along_mid * reduced;
            gradient[axis.inner] = factor.along_inner * reduced + factor.value * tables.inner.slope[slot + i];
        }
    });
}

double evaluate(const Space& space, std::span<const double> coefficients, const Point& xi) {
    assert(coefficients.size() == n_modes(space));
    if (is_constant(space))
        return coefficients[0];
    ModeTables tables;
    fill(tables, space, xi);
    double result = 0;
    for_each_run(space, [&](const Run& run) {
        const double* inner = tables.inner.value + inner_slot(space, run.inner);
        const double* c = coefficients.data() + run.first;
        double sum = 0;
        for (int i = 0; i < run.count; ++i)
            sum += c[i] * inner[i];
        result += tables.outer.value[outer_slot(run.outer)] * tables.mid.value[outer_slot(run.mid)] * sum;
    });
    return result;
}

double evaluate(const Space& space, std::span<const double> coefficients, const Point& xi, Point& gradient) {
    assert(coefficients.size() == n_modes(space));
    double value = 0;
    evaluate_together(space, coefficients, xi, std::span(&value, 1), gradient);
    return value;
}

} // namespace elvis::native
