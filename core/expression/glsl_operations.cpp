#include <core/expression/glsl_operations.hpp>

#include <core/expression/glsl_text.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

namespace elvis::expression_glsl {

namespace {

/** Functions of enclosures, in the order of operations. */
constexpr std::array enclosure_names{"negate", "whole_power", "power_to", "sqrt",       "abs",   "sign",   "sin",
                                     "cos",    "tan",         "asin",     "acos",       "atan",  "exp",    "log",
                                     "add",    "subtract",    "multiply", "divide",     "power", "min",    "max",
                                     "atan",   "over_length", "less",     "less_equal", "equal", "length", "select"};
static_assert(enclosure_names.size() ==
              static_cast<std::size_t>(Operation::select) - static_cast<std::size_t>(Operation::negate) + 1);

/** Of operations that GLSL or our library writes as a call. */
const char* real_function(Operation operation) {
    constexpr std::pair<Operation, const char*> functions[] = {{Operation::square_root, "sqrt"},
                                                               {Operation::absolute, "abs"},
                                                               {Operation::sign, "sign"},
                                                               {Operation::sine, "elvis_sin"},
                                                               {Operation::cosine, "elvis_cos"},
                                                               {Operation::arcsine, "elvis_asin"},
                                                               {Operation::arccosine, "elvis_acos"},
                                                               {Operation::arctangent, "elvis_atan"},
                                                               {Operation::exponential, "elvis_exp"},
                                                               {Operation::logarithm, "elvis_log"},
                                                               {Operation::power, "elvis_pow"},
                                                               {Operation::minimum, "min"},
                                                               {Operation::maximum, "max"},
                                                               {Operation::arctangent2, "elvis_atan"},
                                                               {Operation::over_length, "core_over_length"}};
    const auto found =
        std::find_if(std::begin(functions), std::end(functions), [&](const auto& one) { return one.first == operation; });
    assert(found != std::end(functions) && "a leaf is no operation");
    return found->second;
}

} // namespace

std::string real_operation(const Node& node, const Operands& operands) {
    const auto& [a, b, c] = operands;
    const auto truth = [](const std::string& condition) { return condition + " ? elvis_real(1) : elvis_real(0)"; };
    switch (node.operation) {
    case Operation::negate:
        return "-" + a;
    case Operation::whole_power:
        return node.number == 2   ? a + " * " + a
               : node.number == 3 ? a + " * " + a + " * " + a
                                  : call("core_whole_power", {a, std::to_string(static_cast<int>(node.number)) + "u"});
    case Operation::power_to:
        return call("elvis_pow", {a, literal(node.number)});
    case Operation::tangent:
        return call("elvis_sin", {a}) + " / " + call("elvis_cos", {a});
    case Operation::add:
        return a + " + " + b;
    case Operation::subtract:
        return a + " - " + b;
    case Operation::multiply:
        return a + " * " + b;
    case Operation::divide:
        return a + " / " + b;
    case Operation::less:
        return truth(a + " < " + b);
    case Operation::less_equal:
        return truth(a + " <= " + b);
    case Operation::equal:
        return truth(a + " == " + b);
    case Operation::length:
        return "sqrt(" + a + " * " + a + " + " + b + " * " + b + " + " + c + " * " + c + ")";
    case Operation::select:
        return a + " != elvis_real(0) ? " + b + " : " + c;
    default:
        return n_operands(node.operation) == 1 ? call(real_function(node.operation), {a})
                                               : call(real_function(node.operation), {a, b});
    }
}

std::string enclosure_operation(const Node& node, const Operands& operands, const std::string& prefix,
                                const std::string& last) {
    const auto index = static_cast<std::size_t>(node.operation) - static_cast<std::size_t>(Operation::negate);
    assert(node.operation >= Operation::negate && "a leaf is no operation");
    const bool is_square = node.operation == Operation::whole_power && node.number == 2;
    std::string text = prefix + (is_square ? "square" : enclosure_names[index]) + "(" + operands[0];
    for (std::size_t i = 1; i < n_operands(node.operation); ++i) {
        text += ", " + operands[i];
    }
    if (node.operation == Operation::power_to) {
        text += ", " + literal(node.number);
    } else if (node.operation == Operation::whole_power && !is_square) {
        text += ", " + std::to_string(static_cast<int>(node.number)) + "u";
    }
    // A change of sign rounds nothing.
    return text + (node.operation == Operation::negate ? "" : last) + ")";
}

std::string error_operation(const Node& node, const std::string& v, const Operands& operands, const Operands& errors) {
    const auto& [a, b, c] = operands;
    const auto& [ea, eb, ec] = errors;
    switch (node.operation) {
    case Operation::negate:
    case Operation::absolute:
    case Operation::sine:
    case Operation::cosine:
        return ea;
    case Operation::whole_power:
    case Operation::power_to:
        return "abs(" + literal(node.number) + " * " + v + " / " + a + ") * " + ea;
    case Operation::square_root:
        return ea + " / (elvis_real(2) * " + v + ")";
    case Operation::tangent:
        return "(elvis_real(1) + " + v + " * " + v + ") * " + ea;
    case Operation::arcsine:
    case Operation::arccosine:
        return ea + " / sqrt(elvis_real(1) - " + a + " * " + a + ")";
    case Operation::arctangent:
        return ea + " / (elvis_real(1) + " + a + " * " + a + ")";
    case Operation::exponential:
        return v + " * " + ea;
    case Operation::logarithm:
        return ea + " / abs(" + a + ")";
    case Operation::add:
    case Operation::subtract:
        return ea + " + " + eb;
    case Operation::multiply:
        return "abs(" + a + ") * " + eb + " + abs(" + b + ") * " + ea;
    case Operation::divide:
        return "(" + ea + " + abs(" + v + ") * " + eb + ") / abs(" + b + ")";
    case Operation::power:
        return "abs(" + b + " * " + v + " / " + a + ") * " + ea + " + abs(" + v + " * elvis_log(abs(" + a + "))) * " + eb;
    case Operation::minimum:
    case Operation::maximum:
        return "max(" + ea + ", " + eb + ")";
    case Operation::arctangent2:
        return "(abs(" + b + ") * " + ea + " + abs(" + a + ") * " + eb + ") / (" + a + " * " + a + " + " + b + " * " + b + ")";
    case Operation::over_length:
        return "(" + ea + " + " + eb + ") / abs(" + b + ")";
    case Operation::length:
        return "sqrt(" + ea + " * " + ea + " + " + eb + " * " + eb + " + " + ec + " * " + ec + ")";
    case Operation::select:
        return a + " != elvis_real(0) ? " + eb + " : " + ec;
    default:
        // Signs and comparisons: constant but for jumps.
        return "elvis_real(0)";
    }
}

} // namespace elvis::expression_glsl
