/**
 * @file jacobian_corpus.hpp
 * Elements whose Jacobian's sign is known from how they are made.
 */
#pragma once

#include <elvis/native/jacobian.hpp>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace elvis::native {

struct CorpusElement {
    Space space;
    /** [direction * n_modes + mode] */
    std::vector<double> coefficients;
    bool is_negative = false;
    /** How it was made, for messages. */
    std::string origin;
};

/** The same 4 n elements for the same seed, n of each shape. */
std::vector<CorpusElement> jacobian_corpus(unsigned seed, int n);

/** Coefficients of the space's best fit to a mapping; exact but for rounding where the space contains it. */
std::vector<double> fit_mapping(const Space& space, const std::function<Point(const Point&)>& mapping);

/** Independent of all Bernstein forms: from the gradients of the modes. */
double determinant_at(const Space& space, std::span<const double> coefficients, const Point& xi);

} // namespace elvis::native
