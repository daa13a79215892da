#include <core/expression/glsl.hpp>

#include <core/expression/glsl_nodes.hpp>
#include <core/expression/glsl_operations.hpp>
#include <core/expression/glsl_text.hpp>

#include <cassert>
#include <cmath>
#include <limits>

namespace elvis {

using namespace expression_glsl;

namespace {

double lacking(const Node& node, const std::array<double, 3>& origin) {
    return node.operation == Operation::position ? origin[node.index[0]] : 0;
}

std::string interval_of(double number) {
    // Integers of moderate size are exact in both precisions.
    const bool is_exact = number == std::floor(number) && std::abs(number) < 1e6;
    return call(is_exact ? "core_interval_number" : "core_interval_near", {literal(number)});
}

/** A coordinate, with what the host may lose where it puts constants together with its origin. */
std::string interval_of(const Node& position, const std::array<double, 3>& origin) {
    constexpr const char* axes[] = {"x", "y", "z"};
    const std::string axis = axes[position.index[0]];
    const double loss =
        static_cast<double>(4 * std::numeric_limits<long double>::epsilon() * std::abs(origin[position.index[0]]));
    return loss == 0 ? axis : call("core_interval_add", {axis, call("core_interval", {literal(-loss), literal(loss)})});
}

NodeWriter::Dialect interval_dialect(const std::array<double, 3>& origin) {
    return {
        "core_interval",
        "core_interval_",
        [&origin](const Node& node) {
            return node.operation == Operation::constant ? interval_of(node.number) : interval_of(node, origin);
        },
        [](const Node& node, const Operands& operands) { return enclosure_operation(node, operands, "core_interval_", ""); },
        [](const std::string& variable, double constant) {
            return call("core_interval_add", {variable, interval_of(constant)});
        },
        [&origin](const Node& node) { return lacking(node, origin); }};
}

/**
 * A condition in GLSL, of the nodes' intervals: that all is continuous there where it has a value, so that derivatives tell how
 * the value can change.
 */
std::string continuity(const Graph& graph, const std::vector<NodeId>& needed, NodeWriter& intervals) {
    const auto of = [&](NodeId id, const char* end) { return intervals.whole(id) + end; };
    std::string text = "true";
    for (const NodeId id : needed) {
        const Node& node = graph.node(id);
        const auto [a, b, c] = node.operands;
        switch (node.operation) {
        case Operation::sign:
        case Operation::less:
        case Operation::less_equal:
        case Operation::equal:
            text += " && " + of(id, ".lower == ") + of(id, ".upper");
            break;
        case Operation::arctangent2:
            text += " && (" + of(a, ".lower > elvis_real(0) || ") + of(a, ".upper < elvis_real(0) || ") +
                    of(b, ".lower > elvis_real(0))");
            break;
        case Operation::over_length:
            text += " && " + of(b, ".lower > elvis_real(0)");
            break;
        default:
            break;
        }
    }
    return text;
}

} // namespace

std::string implicit_glsl(const Expression& expression, const std::array<double, 3>& origin) {
    assert(expression.is_implicit());
    const Graph& graph = expression.graph();
    const auto leaf = [](const Node& node) {
        return node.operation == Operation::constant ? literal(node.number) : "x[" + std::to_string(node.index[0]) + "]";
    };
    const NodeWriter::Dialect reals = real_dialect(leaf, [&](const Node& node) { return lacking(node, origin); });
    const NodeWriter::Dialect intervals = interval_dialect(origin);
    const std::vector<NodeId> of_value = graph.needed({expression.value()});
    std::string text = std::string(real_includes) +
                       "#include \"arithmetic/interval.glsl\"\n#include \"arithmetic/interval_choice.glsl\"\n" +
                       commented(expression);
    text += "elvis_real core_implicit_value(elvis_vec3 x) {\n" + value_body(expression, reals);
    text += "void core_implicit(elvis_vec3 x, out elvis_real value, out elvis_vec3 gradient) {\n" +
            gradient_body(expression, reals);
    NodeWriter range(graph, of_value, intervals);
    const std::string range_of_value = range.whole(expression.value());
    text += "core_interval core_implicit_range(core_interval x, core_interval y, core_interval z) {\n" + range.text() +
            "    return " + range_of_value + ";\n}\n";
    NodeWriter slopes(graph, graph.needed(roots_with_gradient(expression)), intervals);
    const auto& [d0, d1, d2] = expression.gradient().value();
    const std::string results = "    dx = " + slopes.whole(d0) + ";\n    dy = " + slopes.whole(d1) +
                                ";\n    dz = " + slopes.whole(d2) + ";\n    if (!(" + continuity(graph, of_value, slopes) +
                                ")) {\n        dx = dy = dz = core_interval_whole();\n    }\n    return " +
                                slopes.whole(expression.value()) + ";\n}\n";
    return text +
           "core_interval core_implicit_slopes(core_interval x, core_interval y, core_interval z, out core_interval dx, "
           "out core_interval dy, out core_interval dz) {\n" +
           slopes.text() + results;
}

} // namespace elvis
