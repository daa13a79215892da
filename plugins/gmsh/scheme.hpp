/**
 * @file scheme.hpp
 * Bases that a file brings along ($InterpolationScheme).
 */
#pragma once

#include "basis.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gmsh {

/** Largest exponent of a scheme: the largest order of a native space. */
constexpr int max_exponent = static_cast<int>(elvis::native::max_order);

/**
 * f_i = sum_j coefficients(i, j) m_j(u, v, w) with m_j = u^a v^b w^c; on pyramids
 * m_j = (u/(1-w))^a (v/(1-w))^b (1-w)^max(a,b) w^c. An entry of `exponents` is (a, b, c).
 */
std::unique_ptr<Basis> scheme_basis(Topology topology, Eigen::MatrixXd coefficients, std::vector<std::array<int, 3>> exponents);

/** The bases of a scheme by topology. */
using Scheme = std::map<Topology, std::shared_ptr<const Basis>>;

} // namespace gmsh
