/**
 * @file points.hpp
 * Where PyFR's rules put solution points: layout 0 names the rule only.
 */
#pragma once

#include "kind.hpp"

#include <string>
#include <vector>

namespace elvis_pyfr {

/**
 * The `n` points of a rule, or of a list of coordinates, in PyFR's coordinates: two or three numbers each. Throws
 * std::invalid_argument with the reason if they are not known.
 */
std::vector<double> solution_points(const Kind& kind, const std::string& rule, std::size_t n);

} // namespace elvis_pyfr
