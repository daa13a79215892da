/**
 * @file bernstein_tables.hpp
 * From the coefficients of a space to the Bernstein form of its functions in collapsed coordinates.
 *
 * Per run, inner factors are summed first, then mid, then outer ones. The computed coefficients differ from the exact ones by
 * at most gamma sum_m |c_m| w_m, w_m being the product of the largest Bernstein coefficients of the mode's three factors and
 * gamma = K u / (1 - K u), u = 2^-53, K the number of roundings on the way of a term: its products, the additions of the three
 * sums, the matrices' own error (Higham, Accuracy and Stability of Numerical Algorithms, 3.1).
 */
#pragma once

#include <elvis/native/space.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace elvis::native {

struct BernsteinTables {
    /** A run of coefficients with the places of its matrices. */
    struct Part {
        std::size_t first, count, inner, mid;
    };
    /** Parts that share an outer factor. */
    struct Group {
        std::size_t outer;
        std::vector<Part> parts;
    };

    /** Bernstein coefficients a direction (of runs.hpp); the form is stored outer slowest, inner fastest. */
    std::size_t size_outer = 1, size_mid = 1, size_inner = 1;
    std::vector<Group> groups;
    std::vector<double> matrices;
    /** w_m of each mode. */
    std::vector<double> weights;
    /** Rounded up, with room for the rounding of the bound itself and of one subtraction from each result. */
    double gamma = 0;

    explicit BernsteinTables(const Space& space);

    std::size_t size() const { return size_outer * size_mid * size_inner; }
    /** Numbers that `transform` needs besides its result. */
    std::size_t workspace_size() const { return size_inner + size_mid * size_inner; }

    /**
     * Bernstein coefficients of `lanes` functions at once: coefficients[mode * lanes + lane], result[k * lanes + lane],
     * workspace of workspace_size() * lanes numbers.
     */
    template <std::size_t lanes> void transform(const double* coefficients, double* workspace, double* result) const;
};

template <std::size_t lanes>
[[gnu::always_inline]] inline void BernsteinTables::transform(const double* coefficients, double* workspace,
                                                              double* result) const {
    const std::size_t n = size_inner;
    const std::size_t plane = size_mid * n;
    double* const line_sum = workspace;
    double* const plane_sum = line_sum + n * lanes;
    std::fill_n(result, size() * lanes, 0.0);
    for (const Group& group : groups) {
        std::fill_n(plane_sum, plane * lanes, 0.0);
        for (const Part& part : group.parts) {
            std::fill_n(line_sum, n * lanes, 0.0);
            const double* row = matrices.data() + part.inner;
            for (std::size_t i = 0; i < part.count; ++i, row += n) {
                const double* c = coefficients + (part.first + i) * lanes;
                for (std::size_t k = 0; k < n; ++k)
                    for (std::size_t lane = 0; lane < lanes; ++lane)
                        line_sum[k * lanes + lane] += c[lane] * row[k];
            }
            const double* mid = matrices.data() + part.mid;
            for (std::size_t j = 0; j < size_mid; ++j)
                for (std::size_t k = 0; k < n * lanes; ++k)
                    plane_sum[j * n * lanes + k] += mid[j] * line_sum[k];
        }
        const double* outer = matrices.data() + group.outer;
        for (std::size_t i = 0; i < size_outer; ++i)
            for (std::size_t k = 0; k < plane * lanes; ++k)
                result[i * plane * lanes + k] += outer[i] * plane_sum[k];
    }
}

} // namespace elvis::native
