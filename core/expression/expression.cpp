#include <core/expression/expression.hpp>
#include <core/expression/parser.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

constexpr std::array second_derivatives{Operation::bend, Operation::hessian, Operation::mapping_hessian};
constexpr std::array first_derivatives{Operation::slope, Operation::gradient, Operation::bend, Operation::hessian};

} // namespace

Expression::Expression(const std::string& text, std::span<const FieldInfo> fields, std::uint32_t dimension) : m_text(text) {
    ParserScope scope;
    scope.fields = fields;
    scope.dimension = dimension;
    const ParsedExpression parsed = parse_expression(text, scope, m_graph);
    m_value = parsed.value;
    if (parsed.plain_field) {
        m_plain = PlainField{*parsed.plain_field, parsed.plain_component};
    }
    find_gradient(dimension);
    for (const NodeId id : m_graph.needed({m_value})) {
        const Node& node = m_graph.node(id);
        const bool is_of_field = node.operation == Operation::field || node.operation == Operation::gradient ||
                                 node.operation == Operation::hessian ||
                                 (node.operation == Operation::order && node.field != any_field);
        if (is_of_field && std::find(m_fields.begin(), m_fields.end(), node.field) == m_fields.end()) {
            m_fields.push_back(node.field);
        }
    }
}

Expression Expression::implicit(const std::string& text) {
    Expression expression;
    expression.m_text = text;
    expression.m_is_implicit = true;
    ParserScope scope;
    scope.is_implicit = true;
    expression.m_value = parse_expression(text, scope, expression.m_graph).value;
    expression.find_gradient(3);
    return expression;
}

void Expression::find_gradient(std::uint32_t dimension) {
    std::array<NodeId, 3> gradient{};
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
        const std::optional<NodeId> found =
            m_is_implicit ? m_graph.world_derivative(m_value, axis) : m_graph.reference_derivative(m_value, axis);
        if (!found) {
            return;
        }
        gradient[axis] = *found;
    }
    if (dimension < 3 && has({gradient.begin(), gradient.end()}, second_derivatives)) {
        return;
    }
    m_gradient = gradient;
}

bool Expression::has(const std::vector<NodeId>& roots, std::span<const Operation> operations) const {
    const std::vector<NodeId> ids = m_graph.needed(roots);
    return std::any_of(ids.begin(), ids.end(), [&](NodeId id) {
        return std::find(operations.begin(), operations.end(), m_graph.node(id).operation) != operations.end();
    });
}

bool Expression::needs_element_facts() const {
    static constexpr std::array facts{Operation::order, Operation::element};
    return has({m_value}, facts);
}
bool Expression::needs_gradients() const { return has({m_value}, first_derivatives); }
bool Expression::needs_second_derivatives() const { return has({m_value}, second_derivatives); }
bool Expression::gradient_needs_second_derivatives() const {
    return m_gradient && has({m_value, (*m_gradient)[0], (*m_gradient)[1], (*m_gradient)[2]}, second_derivatives);
}

} // namespace elvis
