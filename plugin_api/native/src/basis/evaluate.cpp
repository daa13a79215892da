// Values and gradients of modes and of their sums: products of factors, from tables.
#include "mode_tables.hpp"

#include <cassert>

namespace elvis::native {
namespace {

// Values and derivatives of outer * mid, to be multiplied by inner sums.
struct Product {
    double value;
    double along_outer, along_mid, along_inner;
};

Product product(const ModeTables& tables, const Run& run, bool outer_bends_mid) {
    const std::size_t i = outer_slot(run.outer);
    const std::size_t j = outer_slot(run.mid);
    const OuterTable<1>& a = tables.outer;
    const OuterTable<n_plain_rows>& b = tables.mid;
    return {a.value[i] * b.value[j], a.own[i] * b.value[j],
            a.value[i] * b.own[j] + (outer_bends_mid ? a.later[i] * b.value[j] : 0.0),
            a.later[i] * b.value[j] + a.value[i] * b.later[j]};
}

} // namespace

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
    gradient = {};
    if (is_constant(space))
        return coefficients[0];
    ModeTables tables;
    fill(tables, space, xi);
    const Directions axis = directions(space.shape);
    const bool outer_bends_mid = space.shape == Shape::tetrahedron;
    double result = 0;
    for_each_run(space, [&](const Run& run) {
        const Product factor = product(tables, run, outer_bends_mid);
        const std::size_t slot = inner_slot(space, run.inner);
        const double* c = coefficients.data() + run.first;
        double value = 0;
        double reduced = 0;
        double slope = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(run.count); ++i) {
            value += c[i] * tables.inner.value[slot + i];
            reduced += c[i] * tables.inner.reduced[slot + i];
            slope += c[i] * tables.inner.slope[slot + i];
        }
        result += factor.value * value;
        gradient[axis.outer] += factor.along_outer * reduced;
        gradient[axis.mid] += factor.along_mid * reduced;
        gradient[axis.inner] += factor.along_inner * reduced + factor.value * slope;
    });
    return result;
}

} // namespace elvis::native
