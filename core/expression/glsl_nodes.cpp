#include <core/expression/glsl_nodes.hpp>

#include <cmath>
#include <utility>

namespace elvis::expression_glsl {

NodeWriter::NodeWriter(const Graph& graph, const std::vector<NodeId>& needed, Dialect dialect)
    : m_graph(graph), m_dialect(std::move(dialect)) {
    for (const NodeId id : needed) {
        write(id);
    }
}

std::string NodeWriter::whole(NodeId id) {
    if (m_lacking[id] == 0) {
        return base(id);
    }
    const std::string variable = m_dialect.prefix + "core_whole" + std::to_string(id);
    if (m_shifted.insert(id).second) {
        declare(variable, m_dialect.shifted(base(id), static_cast<double>(m_lacking[id])));
    }
    return variable;
}

void NodeWriter::declare(const std::string& variable, const std::string& value) {
    m_text += "    const " + m_dialect.type + " " + variable + " = " + value + ";\n";
}

void NodeWriter::write(NodeId id) {
    const Node& of = node(id);
    const auto [a, b, c] = of.operands;
    long double lacking = 0;
    const bool is_sum = of.operation == Operation::add || of.operation == Operation::subtract;
    const long double sign = of.operation == Operation::subtract ? -1 : 1;
    if (n_operands(of.operation) == 0) {
        lacking = m_dialect.offset(of);
        declare(base(id), m_dialect.leaf(of));
    } else if (is_sum && is_constant(b) && std::isfinite(node(b).number)) {
        lacking = m_lacking[a] + sign * node(b).number;
        declare(base(id), base(a));
    } else if (is_sum && is_constant(a) && std::isfinite(node(a).number)) {
        Node negation = of;
        negation.operation = Operation::negate;
        lacking = node(a).number + sign * m_lacking[b];
        declare(base(id), sign > 0 ? base(b) : m_dialect.operation(negation, {base(b), {}, {}}));
    } else if (is_sum) {
        lacking = m_lacking[a] + sign * m_lacking[b];
        declare(base(id), m_dialect.operation(of, {base(a), base(b), {}}));
    } else if (of.operation == Operation::negate) {
        lacking = -m_lacking[a];
        declare(base(id), m_dialect.operation(of, {base(a), {}, {}}));
    } else if (of.operation == Operation::multiply && (is_constant(a) || is_constant(b))) {
        lacking = is_constant(a) ? node(a).number * m_lacking[b] : node(b).number * m_lacking[a];
        declare(base(id), m_dialect.operation(of, {base(a), base(b), {}}));
    } else if (of.operation == Operation::divide && is_constant(b)) {
        lacking = m_lacking[a] / node(b).number;
        declare(base(id), m_dialect.operation(of, {base(a), base(b), {}}));
    } else {
        const std::size_t n = n_operands(of.operation);
        const Operands operands{whole(a), n > 1 ? whole(b) : std::string(), n > 2 ? whole(c) : std::string()};
        declare(base(id), m_dialect.operation(of, operands));
    }
    m_lacking[id] = lacking;
}

NodeWriter::Dialect real_dialect(const std::function<std::string(const Node&)>& leaf,
                                 const std::function<double(const Node&)>& offset) {
    return {"elvis_real",
            "",
            leaf,
            real_operation,
            [](const std::string& variable, double constant) { return variable + " + " + literal(constant); },
            offset};
}

std::vector<NodeId> roots_with_gradient(const Expression& expression) {
    const auto& [d0, d1, d2] = expression.gradient().value();
    return {expression.value(), d0, d1, d2};
}

std::string gradient_body(const Expression& expression, const NodeWriter::Dialect& dialect) {
    const auto& [d0, d1, d2] = expression.gradient().value();
    NodeWriter nodes(expression.graph(), expression.graph().needed(roots_with_gradient(expression)), dialect);
    const Operands whole{nodes.whole(d0), nodes.whole(d1), nodes.whole(d2)};
    const std::string value = nodes.whole(expression.value());
    return nodes.text() + "    value = " + value + ";\n    gradient = elvis_vec3(" + whole[0] + ", " + whole[1] + ", " +
           whole[2] + ");\n}\n";
}

std::string value_body(const Expression& expression, const NodeWriter::Dialect& dialect) {
    NodeWriter nodes(expression.graph(), expression.graph().needed({expression.value()}), dialect);
    const std::string value = nodes.whole(expression.value());
    return nodes.text() + "    return " + value + ";\n}\n";
}

} // namespace elvis::expression_glsl
