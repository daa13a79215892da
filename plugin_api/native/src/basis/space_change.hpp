/**
 * @file space_change.hpp
 * The same functions in a larger space.
 */
#pragma once

#include <elvis/native/space.hpp>

#include "matrix.hpp"

#include <span>
#include <vector>

namespace elvis::native {

/** The smallest space of format.md that holds the functions of both, which have the same shape. */
Space common_space(const Space& a, const Space& b);

class SpaceChange {
public:
    /** `to` holds the functions of `from`. */
    SpaceChange(const Space& from, const Space& to);

    /** Adds `scale` times the function with these coefficients to that of `sum`. Sizes: the modes of both spaces. */
    void add(std::span<const double> coefficients, double scale, std::span<double> sum) const;

private:
    /** Where each mode of `from` is in `to`, if `to` has the same modes and more: then nothing is rounded. */
    std::vector<std::size_t> m_places;
    /** Else. */
    device::Matrix m_matrix;
};

} // namespace elvis::native
