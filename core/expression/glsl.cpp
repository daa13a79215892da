#include <core/expression/glsl.hpp>

#include <core/expression/glsl_leaves.hpp>
#include <core/expression/glsl_nodes.hpp>
#include <core/expression/glsl_operations.hpp>
#include <core/expression/glsl_text.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace elvis {

using namespace expression_glsl;

ExpressionClass expression_class(const RuntimeVolume& volume, std::uint32_t element_class) {
    ExpressionClass result;
    result.dimension = volume.dimension();
    result.is_affine = volume.classes()[element_class].is_affine;
    result.capabilities = volume.snippet(element_class).capabilities;
    for (std::uint32_t field = 0; field < volume.fields().size(); ++field) {
        const ClassFieldInfo info = volume.class_field(element_class, field);
        result.orders.push_back(*std::max_element(std::begin(info.order), std::end(info.order)));
    }
    return result;
}

namespace {

NodeWriter::Dialect dialect_of(const LeafWriter& leaves) {
    return real_dialect([&leaves](const Node& node) { return leaves.leaf(node); },
                        [&leaves](const Node& node) { return leaves.offset(node); });
}

} // namespace

std::string value_glsl(const Expression& expression, const ExpressionClass& element_class) {
    const std::vector<NodeId> needed = expression.graph().needed({expression.value()});
    const LeafWriter leaves(expression, element_class, needed);
    return std::string("#define CORE_SHOWN_BY_EXPRESSION 1\n#define CORE_VALUE_FLAGS ") +
           (value_is_estimated(expression, element_class) ? "CORE_FLAG_ESTIMATED\n" : "0u\n") + real_includes +
           commented(expression) + "elvis_real core_shown_value(uint element, elvis_vec3 xi) {\n" + leaves.declarations() +
           value_body(expression, dialect_of(leaves));
}

std::string gradient_glsl(const Expression& expression, const ExpressionClass& element_class) {
    if (!expression.gradient()) {
        return "#include \"field/shown_gradient_default.glsl\"\n";
    }
    const std::vector<NodeId> needed = expression.graph().needed(roots_with_gradient(expression));
    const LeafWriter leaves(expression, element_class, needed);
    return real_includes + commented(expression) +
           "void core_shown_gradient(uint element, elvis_vec3 xi, out elvis_real value, out elvis_vec3 gradient) {\n" +
           leaves.declarations() + gradient_body(expression, dialect_of(leaves));
}

namespace {

/** Whether bounds of everything in it are known: fields, constants, coordinates of affine mappings. */
bool has_certified_model(const Expression& expression, const ExpressionClass& element_class) {
    const std::vector<NodeId> needed = expression.graph().needed({expression.value()});
    return std::all_of(needed.begin(), needed.end(), [&](NodeId id) {
        const Operation operation = expression.graph().node(id).operation;
        return n_operands(operation) > 0 || operation == Operation::constant || operation == Operation::field ||
               operation == Operation::order || operation == Operation::element ||
               (operation == Operation::position && element_class.is_affine);
    });
}

} // namespace

std::string model_glsl(const Expression& expression, const ExpressionClass& element_class) {
    if (!has_certified_model(expression, element_class)) {
        return "#include \"arithmetic/model.glsl\"\n" + gradient_glsl(expression, element_class) +
               "#include \"field/estimated_model.glsl\"\n";
    }
    const std::vector<NodeId> needed = expression.graph().needed({expression.value()});
    LeafWriter leaves(expression, element_class, needed);
    leaves.raise_fields(1);
    if (leaves.needs_position()) {
        leaves.raise_geometry(2);
    }
    const auto row = [&](const Node& node) {
        return "elvis_fetch4_core_bounds" + LeafWriter::instance_suffix(leaves.slot(node.field)) + "(element, " +
               std::to_string(node.component) + "u)";
    };
    const auto leaf = [&](const Node& node) -> std::string {
        if (node.operation == Operation::field) {
            const std::string at = LeafWriter::field_suffix(leaves.slot(node.field), node.component);
            const std::string bounds = call("core_leaf_bounds", {row(node), "xi", "region.radius"});
            return call("core_model_leaf", {"core_f" + at, "core_s" + at, bounds, "region"});
        }
        if (node.operation == Operation::position) {
            const std::string i = std::to_string(node.index[0]);
            const std::string slope =
                call("elvis_vec3", {"core_j[0][" + i + "]", "core_j[1][" + i + "]", "core_j[2][" + i + "]"});
            return call("core_model_coordinate", {"core_x[" + i + "]", slope, "region"});
        }
        return call("core_model_constant", {leaves.leaf(node)});
    };
    std::string text =
        "#include \"arithmetic/model.glsl\"\n#include \"arithmetic/model_choice.glsl\"\n#include "
        "\"field/leaf_bounds.glsl\"\n" +
        commented(expression) +
        "core_model core_shown_model(uint element, elvis_vec3 xi, core_region region, out elvis_real value) {\n" +
        leaves.declarations();
    std::string is_estimated = "false";
    for (const NodeId id : needed) {
        if (expression.graph().node(id).operation == Operation::field) {
            is_estimated += " || " + row(expression.graph().node(id)) + ".w > elvis_real(0)";
        }
    }
    NodeWriter models(
        expression.graph(), needed,
        {"core_model", "core_model_", leaf,
         [](const Node& node, const Operands& operands) {
             return enclosure_operation(node, operands, "core_model_", ", region");
         },
         [](const std::string& variable, double constant) {
             return call("core_model_add", {variable, call("core_model_constant", {literal(constant)}), "region"});
         },
         [&](const Node& node) { return leaves.offset(node); }});
    // What is drawn is the value itself, not the model's, which is 0 where nothing is known.
    NodeWriter values(expression.graph(), needed, dialect_of(leaves));
    const std::string model = models.whole(expression.value()), value = values.whole(expression.value());
    text += models.text() + values.text() + "    value = " + value + ";\n    return " + model + ";\n}\n";
    return text + "bool core_is_model_estimated(uint element) { return " + is_estimated + "; }\n";
}

std::string error_glsl(const Expression& expression, const ExpressionClass& element_class) {
    const Graph& graph = expression.graph();
    const std::vector<NodeId> needed = graph.needed({expression.value()});
    const LeafWriter leaves(expression, element_class, needed);
    std::string text = std::string(real_includes) + "#include \"arithmetic/precision.glsl\"\n" + commented(expression) +
                       "elvis_real core_shown_error(uint element, elvis_vec3 xi) {\n" + leaves.declarations();
    NodeWriter nodes(graph, needed, dialect_of(leaves));
    std::string errors;
    for (const NodeId id : needed) {
        const Node& node = graph.node(id);
        // In units of roundoff: what evaluations of fields and their derivatives show, doubled; what operations lose.
        const bool is_derivative = node.operation == Operation::gradient || node.operation == Operation::hessian;
        const std::string own = node.operation == Operation::constant ? "1"
                                : is_derivative                       ? "64"
                                : n_operands(node.operation) == 0     ? "16"
                                                                      : "2";
        // Of what is computed: constants that were left out lose nothing.
        errors += "    const elvis_real core_error_" + name(id) + " = elvis_real(" + own + ") * CORE_ROUNDOFF * abs(" +
                  name(id) + ")";
        const bool is_sum = node.operation == Operation::add || node.operation == Operation::subtract;
        Operands operands, operand_errors;
        for (std::size_t i = 0; i < n_operands(node.operation); ++i) {
            const NodeId operand = node.operands[i];
            const bool is_left_out = is_sum && graph.node(operand).operation == Operation::constant;
            operands[i] = nodes.whole(operand);
            operand_errors[i] = is_left_out ? "elvis_real(0)" : "core_error_" + name(operand);
            // A constant that is put in rounds.
            if (!is_sum && operands[i] != name(operand)) {
                operand_errors[i] = "(" + operand_errors[i] + " + CORE_ROUNDOFF * abs(" + operands[i] + "))";
            }
        }
        errors += n_operands(node.operation) == 0
                      ? ";\n"
                      : " + (" + error_operation(node, nodes.whole(id), operands, operand_errors) + ");\n";
    }
    const std::string value = nodes.whole(expression.value());
    text += nodes.text() + errors;
    return text + "    return core_error_" + name(expression.value()) + " + CORE_ROUNDOFF * abs(" + value + ");\n}\n";
}

bool value_is_estimated(const Expression& expression, const ExpressionClass& element_class) {
    const auto lacks = [&](std::uint32_t capability) { return (element_class.capabilities & capability) == 0; };
    return (expression.needs_gradients() && lacks(ELVIS_SNIPPET_FIELD_GRADIENT)) ||
           (expression.needs_second_derivatives() &&
            (lacks(ELVIS_SNIPPET_FIELD_HESSIAN) || lacks(ELVIS_SNIPPET_MAPPING_HESSIAN)));
}

bool gradient_is_estimated(const Expression& expression, const ExpressionClass& element_class) {
    const auto lacks = [&](std::uint32_t capability) { return (element_class.capabilities & capability) == 0; };
    return !expression.gradient() || lacks(ELVIS_SNIPPET_FIELD_GRADIENT) ||
           (expression.gradient_needs_second_derivatives() &&
            (lacks(ELVIS_SNIPPET_FIELD_HESSIAN) || lacks(ELVIS_SNIPPET_MAPPING_HESSIAN)));
}

} // namespace elvis
