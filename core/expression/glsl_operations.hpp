/**
 * @file glsl_operations.hpp
 * Operations of expressions in GLSL, of operands that have names.
 */
#pragma once

#include <core/expression/graph.hpp>

#include <array>
#include <string>

namespace elvis::expression_glsl {

/** Names of the operands of a node. */
using Operands = std::array<std::string, 3>;

std::string real_operation(const Node& node, const Operands& operands);
/** The same for types whose functions are PREFIX_add(a, b) and so on; `last` ends every list of arguments. */
std::string enclosure_operation(const Node& node, const Operands& operands, const std::string& prefix, const std::string& last);
/**
 * First-order error of an operation from those of its operands, beyond its own rounding: sum of |derivative| times error.
 * @param v  the operation's value
 */
std::string error_operation(const Node& node, const std::string& v, const Operands& operands, const Operands& errors);

} // namespace elvis::expression_glsl
