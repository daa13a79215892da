/**
 * @file poles.hpp
 * Where expressions grow without limit.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/expression/expression.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdint>

namespace elvis {

/**
 * Whether the value grows without limit about a place where it was found to be largest or smallest: there the denominator of a
 * quotient, whose numerator is not, or the operand of a logarithm, of a negative power or of a tangent's cosine is less than
 * 1e-5 of what it is elsewhere in the element, or, if it is a root, 1e-3. That near do searches come to a pole. What falls so
 * low without being zero is taken for a pole, too. Needs RuntimeVolume::has_evaluation(). `element` counts as in the volume.
 */
bool is_near_pole(const Expression& expression, const RuntimeVolume& volume, std::uint32_t time_step, std::uint64_t element,
                  const Vector3& xi);

} // namespace elvis
