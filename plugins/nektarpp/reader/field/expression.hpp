/**
 * @file expression.hpp
 * Constant expressions in the attributes XSCALE, XMOVE etc.: "2*PI", "-sqrt(2)/2".
 */
#pragma once

#include <string>

namespace nektarpp {

/**
 * Numbers, + - * / ^, parentheses, the constants PI and E, and abs sqrt exp log log10 sin cos tan asin acos atan sinh cosh tanh
 * floor ceil. Throws std::invalid_argument with the place if the text is no such expression or its value is not finite.
 */
double evaluate_expression(const std::string& text);

} // namespace nektarpp
