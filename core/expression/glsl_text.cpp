#include <core/expression/glsl_text.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace elvis::expression_glsl {

std::string literal(double number) {
    if (!std::isfinite(number)) {
        return std::isnan(number) ? "core_nan()" : number > 0 ? "core_infinity()" : "(-core_infinity())";
    }
    char digits[40];
    const auto end = std::to_chars(digits, digits + sizeof digits, number).ptr;
    std::string text(digits, end);
    if (text.find_first_of(".e") == std::string::npos) {
        text += ".0";
    }
    return "elvis_real(" + text + "LF)";
}

std::string name(NodeId id) { return "core_n" + std::to_string(id); }

std::string call(const std::string& function, std::initializer_list<std::string> arguments) {
    std::string text = function + "(";
    for (const std::string& argument : arguments) {
        text += (text.back() == '(' ? "" : ", ") + argument;
    }
    return text + ")";
}

std::string commented(const Expression& expression) {
    std::string text = expression.text();
    // One line, and no backslash that would continue the comment.
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\\' || (c & 0x80) != 0; }, ' ');
    return "// " + text + "\n";
}

} // namespace elvis::expression_glsl
