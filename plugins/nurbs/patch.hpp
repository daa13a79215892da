/**
 * @file patch.hpp
 * Knot spans of a patch in Bezier form.
 */
#pragma once

#include "nurbs_file.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace elvis::nurbs {

/** A non-empty knot span. */
struct Element {
    std::uint32_t patch = 0;
    /** Number of the span among the non-empty ones, in each direction. */
    std::array<std::uint32_t, 3> span{};
    /**
     * Bezier coefficients, the first direction fastest; for each w x, w y, w z, w and w c for every component of every field.
     */
    std::vector<double> coefficients;
};

/** Elements of a patch, the first direction fastest. */
std::vector<Element> extract_elements(const PatchData& patch, std::uint32_t number, std::size_t width);

/**
 * The sum of Bernstein polynomials of given degrees over [-1,1]^3 and its derivatives, for the numbers first .. first+count-1
 * of each coefficient: four numbers each (value, then by xi1, xi2, xi3).
 */
void evaluate_bezier(const Element& element, const std::array<int, 3>& degree, std::size_t width, std::size_t first,
                     std::size_t count, const double* xi, double* out);

} // namespace elvis::nurbs
