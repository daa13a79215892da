/**
 * @file tables.hpp
 * What the segment polynomial knows beforehand: where to sample, and how samples become coefficients. Computed once, here, for
 * the functions on the CPU and for those on the device.
 *
 * A field along a segment, t in [0, 1], is sampled at the Chebyshev-Lobatto nodes t = (1 - cos(pi j / n)) / 2 of a degree n,
 * whose interpolant has the Chebyshev coefficients (Trefethen, Approximation Theory and Approximation Practice, chapters 3 and
 * 4) c_k = (2 - [k = 0] - [k = n]) / n  sum over j of w_j f(t_j) cos(pi j k / n),   w = 1/2 at both ends, else 1. It is judged
 * at two points between nodes, which are nodes of none of the degrees: at the nodes of degree 2 n, T_(4 n - k) is T_k, and a
 * field of that kind would look like a good fit.
 */
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace elvis::segment {

constexpr int max_degree = 13;
constexpr int n_checks = 2;

/** One degree of the plan: rows of numbers that all samples are multiplied with, zero for those that are of no use to it. */
struct Level {
    int degree = 0;
    /** It can be judged when that many samples are there. */
    int n_samples = 0;
    /** The Chebyshev coefficients, 0 .. degree. */
    std::vector<std::vector<double>> fit;
    /**
     * The polynomial of degree + 2 through nodes and check points differs from the interpolant by at most the sum of these,
     * without their signs: each is the misfit at a check point times the largest value of the polynomial that is 1 there and 0
     * at the others.
     */
    std::array<std::vector<double>, n_checks> misfit;
};

/** Where to sample, in which order, and after which samples to judge. */
struct SamplePlan {
    /** The highest degree. */
    int degree = 0;
    /** The first two are 0 and 1. */
    std::vector<double> parameters;
    std::vector<Level> levels;
};

/** Degrees 2, 4 and 8, judged after 5, 7 and 11 samples. The third sample is at 1/2. */
SamplePlan nested_plan();
/** This degree alone, 2 to max_degree. */
SamplePlan fixed_plan(int degree);

/**
 * Coefficient j of T_k (2 t - 1) in the Bernstein basis of degree n, at [j (n + 1) + k] (Rababah 2003, Transformation of
 * Chebyshev-Bernstein polynomial basis, theorem 1).
 */
std::vector<double> bernstein_of_chebyshev(int n);
/** The largest of its numbers, without sign, for each k: how much T_k loses in the Bernstein basis. */
std::vector<double> bernstein_growth(int n);
/** n over i, for i = 0 .. n. */
std::vector<double> binomials(int n);

/** All of it as GLSL, which segments/polynomial.glsl needs before it. */
std::string segment_glsl(const SamplePlan& plan);

} // namespace elvis::segment
