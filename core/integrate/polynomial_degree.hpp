/**
 * @file polynomial_degree.hpp
 * Whether an expression is a polynomial in the elements of a class, which quadrature integrates exactly.
 */
#pragma once

#include <core/expression/expression.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>
#include <optional>

namespace elvis {

/** Of the mapping, in each collapsed coordinate; nothing if it is not polynomial there. */
std::optional<unsigned> mapping_degree(const RuntimeVolume& volume, std::uint32_t element_class);

/** No degree in a collapsed coordinate is larger; nothing if the expression is not known to be a polynomial. */
std::optional<unsigned> polynomial_degree(const Expression& expression, const RuntimeVolume& volume,
                                          std::uint32_t element_class);

} // namespace elvis
