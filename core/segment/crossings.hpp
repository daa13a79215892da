/**
 * @file crossings.hpp
 * Where a polynomial takes given values, in order along the segment: the CPU's twin of shaders/segments/crossings.glsl,
 * where the method is explained.
 */
#pragma once

#include <core/segment/polynomial.hpp>

#include <bit>
#include <span>

namespace elvis::segment {

enum class CrossingKind : std::uint32_t {
    none = 0,
    /** The field itself crosses: at the ends of the bracket it is on both sides of the value by more than the error. */
    verified = 1,
    /** The polynomial crosses, but comes closer than the error at an end of the bracket. */
    probable = 2,
    /** The polynomial comes as close as the error: a touch, or a crossing beside an end. */
    touch = 3
};

template <class Real> struct Crossing {
    CrossingKind kind = CrossingKind::none;
    /** In the list of values. */
    std::uint32_t index = 0;
    Real t = 0;
    /** Of the interval in which it lies: no other crossing of this value is in there, unless it is a touch. */
    Real lower = 0, upper = 0;
};

/** The interval at hand, [part, part + 1] / 2^level, and how many of its crossings have been found before. */
struct Isolation {
    std::uint32_t level = 0, part = 0, rank = 0;

    bool is_over() const { return level == 0 && part != 0; }
    /** The next interval of the same size, or that of which it is the left end. */
    void go_on() {
        const int up = std::countr_zero(part + 1);
        part = (part + 1) >> up;
        level -= static_cast<std::uint32_t>(up);
        rank = 0;
    }
};

/** A double root takes as many levels as half the digits. What is left at the last is taken as settled. */
template <class Real> constexpr std::uint32_t isolation_levels = sizeof(Real) == 8 ? 30 : 16;

/** Root of p - value in [0, 1], which has different signs at the ends (or zero at the second). */
template <class Real> Real polish(const Polynomial<Real>& p, Real value) {
    constexpr int n_steps = 48;
    Real a = 0, b = 1, fa = p[0] - value, fb = p[p.degree] - value;
    if (fa == 0 || fb == 0) {
        return fa == 0 ? a : b;
    }
    Real x = b;
    for (int iteration = 0; iteration < n_steps; ++iteration) {
        const Real last = x;
        x = a + (b - a) * (fa / (fa - fb));
        const Real fx = bernstein_value(p, x) - value;
        // The end that stays for a second time counts half.
        if ((fx < 0) == (fb < 0)) {
            fa *= iteration > 0 && last == b ? Real(0.5) : Real(1);
            b = x;
            fb = fx;
        } else {
            fb *= iteration > 0 && last == a ? Real(0.5) : Real(1);
            a = x;
            fa = fx;
        }
        if (fx == 0 || std::abs(x - last) <= 4 * roundoff<Real>) {
            break;
        }
    }
    return x;
}

/** The first crossing from `isolation` on, of any of the ascending `values`; `error` is at least bernstein_rounding. */
template <class Real>
Crossing<Real> next_crossing(const Polynomial<Real>& bernstein, Real error, std::span<const Real> values,
                             Isolation& isolation) {
    while (!isolation.is_over()) {
        const Isolation here = isolation;
        const Polynomial<Real> cell = cell_of(bernstein, here.level, here.part);
        const Real first = cell[0], last = cell[cell.degree];
        const std::array<Real, 2> bounds = range(cell); // A structured binding, captured below, is beyond clang 14.
        // NaN has no value below.
        const auto below = std::partition_point(values.begin(), values.end(), [&](Real v) { return v < bounds[0] - error; });
        const auto above = std::partition_point(values.begin(), values.end(), [&](Real v) { return v <= bounds[1] + error; });
        const auto n_below = static_cast<std::uint32_t>(below - values.begin());
        const auto n_reached = static_cast<std::uint32_t>(above - below);
        if (here.rank >= n_reached) {
            isolation.go_on();
            continue;
        }
        const bool rises = first < last;
        const std::uint32_t index = rises ? n_below + here.rank : n_below + n_reached - 1 - here.rank;
        const Real value = values[index], from = first - value, to = last - value;
        const bool is_clear = std::abs(from) > error && std::abs(to) > error;
        const bool is_small = bounds[1] - bounds[0] <= 2 * error || here.level == isolation_levels<Real>;
        const bool is_isolated = n_reached == 1 && is_clear && variations(cell, value) == 1;
        if (!is_small && !is_isolated && !is_monotone(cell)) {
            isolation = {here.level + 1, here.part * 2, 0};
            continue;
        }
        if (here.rank + 1 < n_reached) {
            isolation.rank += 1;
        } else {
            isolation.go_on();
        }
        // A value met at the beginning of an interval belongs to the one before.
        const bool crosses = (from < 0 && to >= 0) || (from > 0 && to <= 0) || (from == 0 && to != 0 && here.part == 0);
        // Monotone, and stops within the error of the value, or starts there: the end of the segment, or where it may turn
        // round.
        const bool stops = rises ? to < 0 : to > 0;
        if (!crosses && !is_small && !stops && here.part != 0) {
            continue;
        }
        const Real in_cell = crosses ? polish(cell, value) : is_small ? Real(0.5) : stops ? Real(1) : Real(0);
        const Real size = 1 / static_cast<Real>(1u << here.level);
        return {!crosses   ? CrossingKind::touch
                : is_clear ? CrossingKind::verified
                           : CrossingKind::probable,
                index, (static_cast<Real>(here.part) + in_cell) * size, static_cast<Real>(here.part) * size,
                static_cast<Real>(here.part + 1) * size};
    }
    return {};
}

} // namespace elvis::segment
