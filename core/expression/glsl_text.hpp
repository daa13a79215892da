/**
 * @file glsl_text.hpp
 * Small pieces of GLSL that expressions are written with.
 */
#pragma once

#include <core/expression/expression.hpp>

#include <initializer_list>
#include <string>

namespace elvis::expression_glsl {

/** A number as GLSL writes it in the precision in use. */
std::string literal(double number);
/** The variable of a node. */
std::string name(NodeId id);
std::string call(const std::string& function, std::initializer_list<std::string> arguments);
/** The expression's text as one line of comment. */
std::string commented(const Expression& expression);

} // namespace elvis::expression_glsl
