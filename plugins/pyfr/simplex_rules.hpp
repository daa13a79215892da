/**
 * @file simplex_rules.hpp
 * Tabulated points of PyFR on triangles and tetrahedra.
 */
#pragma once

#include "kind.hpp"

#include <string>
#include <vector>

namespace elvis_pyfr {

/** The `n` points of a rule, two or three coordinates each, in PyFR's order; empty if they are not known. */
std::vector<double> simplex_points(const Kind& kind, const std::string& rule, std::size_t n);

} // namespace elvis_pyfr
