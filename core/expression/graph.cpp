#include <core/expression/graph.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace elvis {

std::size_t n_operands(Operation operation) {
    return operation < Operation::negate ? 0 : operation < Operation::add ? 1 : operation < Operation::length ? 2 : 3;
}

double apply(const Node& node, double a, double b, double c) {
    switch (node.operation) {
    case Operation::negate:
        return -a;
    case Operation::whole_power:
    case Operation::power_to:
        return std::pow(a, node.number);
    case Operation::square_root:
        return std::sqrt(a);
    case Operation::absolute:
        return std::abs(a);
    case Operation::sign:
        return a > 0 ? 1 : a < 0 ? -1 : 0;
    case Operation::sine:
        return std::sin(a);
    case Operation::cosine:
        return std::cos(a);
    case Operation::tangent:
        return std::tan(a);
    case Operation::arcsine:
        return std::asin(a);
    case Operation::arccosine:
        return std::acos(a);
    case Operation::arctangent:
        return std::atan(a);
    case Operation::exponential:
        return std::exp(a);
    case Operation::logarithm:
        return std::log(a);
    case Operation::add:
        return a + b;
    case Operation::subtract:
        return a - b;
    case Operation::multiply:
        return a * b;
    case Operation::divide:
        return a / b;
    case Operation::power:
        return std::pow(a, b);
    case Operation::minimum:
        return std::min(a, b);
    case Operation::maximum:
        return std::max(a, b);
    case Operation::arctangent2:
        return std::atan2(a, b);
    case Operation::over_length:
        return b == 0 ? 0 : a / b;
    case Operation::less:
        return a < b ? 1 : 0;
    case Operation::less_equal:
        return a <= b ? 1 : 0;
    case Operation::equal:
        return a == b ? 1 : 0;
    case Operation::length:
        return std::sqrt(a * a + b * b + c * c);
    case Operation::select:
        return a != 0 ? b : c;
    default:
        assert(false && "a leaf has no operands");
        return 0;
    }
}

NodeId Graph::add(const Node& node) {
    const std::size_t n = n_operands(node.operation);
    const bool is_constant = n > 0 && std::all_of(node.operands.begin(), node.operands.begin() + static_cast<std::ptrdiff_t>(n),
                                                  [this](NodeId id) { return number(id).has_value(); });
    if (is_constant) {
        const auto at = [&](std::size_t i) { return i < n ? *number(node.operands[i]) : 0.0; };
        return constant(apply(node, at(0), at(1), at(2)));
    }
    const auto [found, is_new] = m_ids.try_emplace(node, static_cast<NodeId>(m_nodes.size()));
    if (is_new) {
        m_nodes.push_back(node);
    }
    return found->second;
}

std::optional<double> Graph::number(NodeId id) const {
    return m_nodes[id].operation == Operation::constant ? std::optional(m_nodes[id].number) : std::nullopt;
}

bool Graph::is(NodeId id, double value) const {
    return m_nodes[id].operation == Operation::constant && m_nodes[id].number == value;
}

NodeId Graph::constant(double number) {
    Node node;
    // A NaN is unequal to itself, which no map could find again; and 0 has one sign.
    node.number = number == 0 ? 0 : number;
    if (std::isnan(number)) {
        m_nodes.push_back(node);
        return static_cast<NodeId>(m_nodes.size() - 1);
    }
    return add(node);
}

NodeId Graph::leaf(Operation operation, std::uint8_t i, std::uint8_t j, std::uint8_t k) {
    Node node;
    node.operation = operation;
    node.index = {i, j, k};
    if (operation == Operation::mapping_hessian) {
        node.index = {i, std::min(j, k), std::max(j, k)};
    }
    return add(node);
}

NodeId Graph::field_leaf(Operation operation, std::uint32_t field, std::uint32_t component, std::uint8_t i, std::uint8_t j) {
    Node node;
    node.operation = operation;
    node.field = field;
    node.component = component;
    const bool is_symmetric = operation == Operation::bend || operation == Operation::hessian;
    node.index = is_symmetric ? std::array{std::min(i, j), std::max(i, j), std::uint8_t{0}} : std::array{i, j, std::uint8_t{0}};
    return add(node);
}

NodeId Graph::unary(Operation operation, NodeId a) {
    if (operation == Operation::negate && m_nodes[a].operation == Operation::negate) {
        return m_nodes[a].operands[0];
    }
    Node node;
    node.operation = operation;
    node.operands = {a, 0, 0};
    return add(node);
}

NodeId Graph::binary(Operation operation, NodeId a, NodeId b) {
    // Derivatives are full of zeros and ones. What is left out loses at most a NaN that a factor of zero would have hidden.
    switch (operation) {
    case Operation::add:
        if (is(a, 0) || is(b, 0)) {
            return is(a, 0) ? b : a;
        }
        if (m_nodes[b].operation == Operation::negate) {
            return binary(Operation::subtract, a, m_nodes[b].operands[0]);
        }
        break;
    case Operation::subtract:
        if (is(b, 0)) {
            return a;
        }
        if (is(a, 0)) {
            return unary(Operation::negate, b);
        }
        break;
    case Operation::multiply:
        if (is(a, 0) || is(b, 0)) {
            return constant(0);
        }
        if (is(a, 1) || is(b, 1)) {
            return is(a, 1) ? b : a;
        }
        if (is(a, -1) || is(b, -1)) {
            return unary(Operation::negate, is(a, -1) ? b : a);
        }
        if (a == b) {
            return whole_power(a, 2);
        }
        break;
    case Operation::divide:
        if (is(b, 1) || is(a, 0)) {
            return a;
        }
        break;
    case Operation::power:
        return power(a, b);
    case Operation::over_length:
        if (is(a, 0)) {
            return a;
        }
        break;
    default:
        break;
    }
    const bool commutes = operation == Operation::add || operation == Operation::multiply || operation == Operation::minimum ||
                          operation == Operation::maximum || operation == Operation::equal;
    Node node;
    node.operation = operation;
    node.operands = commutes ? std::array{std::min(a, b), std::max(a, b), NodeId{0}} : std::array{a, b, NodeId{0}};
    return add(node);
}

NodeId Graph::whole_power(NodeId a, std::uint32_t exponent) {
    if (exponent < 2) {
        return exponent == 0 ? constant(1) : a;
    }
    Node node;
    node.operation = Operation::whole_power;
    node.operands = {a, 0, 0};
    node.number = exponent;
    return add(node);
}

NodeId Graph::power(NodeId a, NodeId b) {
    const std::optional<double> exponent = number(b);
    Node node;
    node.operands = {a, b, 0};
    if (!exponent) {
        node.operation = Operation::power;
        return add(node);
    }
    // As far as GLSL's powers by products go.
    if (*exponent == std::floor(*exponent) && std::abs(*exponent) <= 255) {
        const NodeId positive = whole_power(a, static_cast<std::uint32_t>(std::abs(*exponent)));
        return *exponent < 0 ? binary(Operation::divide, constant(1), positive) : positive;
    }
    if (std::abs(*exponent) == 0.5) {
        const NodeId root = unary(Operation::square_root, a);
        return *exponent < 0 ? binary(Operation::divide, constant(1), root) : root;
    }
    node.operation = Operation::power_to;
    node.operands = {a, 0, 0};
    node.number = *exponent;
    return add(node);
}

NodeId Graph::length(NodeId a, NodeId b, NodeId c) {
    Node node;
    node.operation = Operation::length;
    node.operands = {a, b, c};
    return add(node);
}

NodeId Graph::select(NodeId condition, NodeId a, NodeId b) {
    if (a == b) {
        return a;
    }
    if (const std::optional<double> known = number(condition)) {
        return *known != 0 ? a : b;
    }
    Node node;
    node.operation = Operation::select;
    node.operands = {condition, a, b};
    return add(node);
}

NodeId Graph::sum(const std::vector<NodeId>& terms) {
    NodeId result = constant(0);
    for (const NodeId term : terms) {
        result = binary(Operation::add, result, term);
    }
    return result;
}

std::vector<NodeId> Graph::needed(const std::vector<NodeId>& roots) const {
    std::vector<bool> is_needed(m_nodes.size(), false);
    for (const NodeId root : roots) {
        is_needed[root] = true;
    }
    // Operands come before their node.
    for (std::size_t id = m_nodes.size(); id-- > 0;) {
        for (std::size_t i = 0; is_needed[id] && i < n_operands(m_nodes[id].operation); ++i) {
            is_needed[m_nodes[id].operands[i]] = true;
        }
    }
    std::vector<NodeId> ids;
    for (NodeId id = 0; id < m_nodes.size(); ++id) {
        if (is_needed[id]) {
            ids.push_back(id);
        }
    }
    return ids;
}

} // namespace elvis
