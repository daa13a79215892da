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

std::optional<NodeId> Graph::derivative(NodeId id, std::uint8_t axis, bool is_world) {
    const std::array<std::uint32_t, 3> key{id, axis, is_world ? 1u : 0u};
    if (const auto found = m_derivatives.find(key); found != m_derivatives.end()) {
        return found->second;
    }
    // Depth-first by hand: an expression may be as deep as its text is long.
    for (const NodeId one : needed({id})) {
        const std::array<std::uint32_t, 3> one_key{one, axis, is_world ? 1u : 0u};
        if (m_derivatives.contains(one_key)) {
            continue;
        }
        const Node node = m_nodes[one];
        std::optional<NodeId> result;
        if (n_operands(node.operation) == 0) {
            result = leaf_derivative(node, axis, is_world);
        } else {
            std::array<NodeId, 3> operands{};
            bool is_known = true;
            for (std::size_t i = 0; i < n_operands(node.operation); ++i) {
                const std::optional<NodeId> of_operand = m_derivatives.at({node.operands[i], axis, is_world ? 1u : 0u});
                // A condition is constant but for jumps.
                const bool is_condition = node.operation == Operation::less || node.operation == Operation::less_equal ||
                                          node.operation == Operation::equal || (node.operation == Operation::select && i == 0);
                operands[i] = is_condition ? constant(0) : of_operand.value_or(0);
                is_known = is_known && (is_condition || of_operand);
            }
            result = is_known ? std::optional(chain(one, operands)) : std::nullopt;
        }
        m_derivatives.emplace(one_key, result);
    }
    return m_derivatives.at(key);
}

std::optional<NodeId> Graph::leaf_derivative(const Node& node, std::uint8_t axis, bool is_world) {
    const std::uint8_t i = node.index[0], j = node.index[1];
    const auto of_field = [&](Operation operation, std::uint8_t first, std::uint8_t second) {
        return field_leaf(operation, node.field, node.component, first, second);
    };
    const auto times = [&](NodeId a, NodeId b) { return binary(Operation::multiply, a, b); };
    // sum_l d/dxi_l K_l,axis
    const auto through_reference = [&](const auto& by_reference) {
        std::vector<NodeId> terms;
        for (std::uint8_t l = 0; l < 3; ++l) {
            terms.push_back(times(by_reference(l), leaf(Operation::inverse_jacobian, l, axis)));
        }
        return sum(terms);
    };
    const auto either = [&](const auto& by_reference) {
        return is_world ? through_reference(by_reference) : by_reference(axis);
    };
    switch (node.operation) {
    case Operation::constant:
    case Operation::order:
    case Operation::element:
        return constant(0);
    case Operation::position:
        return is_world ? constant(i == axis ? 1 : 0) : leaf(Operation::jacobian, i, axis);
    case Operation::field:
        return of_field(is_world ? Operation::gradient : Operation::slope, axis, 0);
    case Operation::gradient: {
        if (is_world) {
            return of_field(Operation::hessian, i, axis);
        }
        std::vector<NodeId> terms;
        for (std::uint8_t b = 0; b < 3; ++b) {
            terms.push_back(times(leaf(Operation::inverse_jacobian, b, i), of_field(Operation::bend, b, axis)));
        }
        return sum(terms);
    }
    case Operation::jacobian:
        return either([&](std::uint8_t l) { return leaf(Operation::mapping_hessian, i, j, l); });
    case Operation::inverse_jacobian:
        return either([&](std::uint8_t l) {
            std::vector<NodeId> terms;
            for (std::uint8_t a = 0; a < 3; ++a) {
                for (std::uint8_t b = 0; b < 3; ++b) {
                    terms.push_back(
                        times(times(leaf(Operation::inverse_jacobian, i, a), leaf(Operation::mapping_hessian, a, b, l)),
                              leaf(Operation::inverse_jacobian, b, j)));
                }
            }
            return unary(Operation::negate, sum(terms));
        });
    default:
        return std::nullopt;
    }
}

NodeId Graph::chain(NodeId id, const std::array<NodeId, 3>& derivatives) {
    const Node node = m_nodes[id];
    const auto [a, b, c] = node.operands;
    const auto [da, db, dc] = derivatives;
    const auto plus = [&](NodeId x, NodeId y) { return binary(Operation::add, x, y); };
    const auto minus = [&](NodeId x, NodeId y) { return binary(Operation::subtract, x, y); };
    const auto times = [&](NodeId x, NodeId y) { return binary(Operation::multiply, x, y); };
    const auto over = [&](NodeId x, NodeId y) { return binary(Operation::divide, x, y); };
    const auto square = [&](NodeId x) { return whole_power(x, 2); };
    const NodeId one = constant(1);
    switch (node.operation) {
    case Operation::negate:
        return unary(Operation::negate, da);
    case Operation::whole_power: {
        const auto n = static_cast<std::uint32_t>(node.number);
        return times(times(constant(node.number), whole_power(a, n - 1)), da);
    }
    case Operation::power_to:
        return times(times(constant(node.number), power(a, constant(node.number - 1))), da);
    case Operation::square_root:
        return over(da, times(constant(2), id));
    case Operation::absolute:
        return times(unary(Operation::sign, a), da);
    case Operation::sine:
        return times(unary(Operation::cosine, a), da);
    case Operation::cosine:
        return unary(Operation::negate, times(unary(Operation::sine, a), da));
    case Operation::tangent:
        return times(plus(one, square(id)), da);
    case Operation::arcsine:
    case Operation::arccosine: {
        // (1 - a)(1 + a) keeps its digits near 1.
        const NodeId root = unary(Operation::square_root, times(minus(one, a), plus(one, a)));
        const NodeId result = over(da, root);
        return node.operation == Operation::arcsine ? result : unary(Operation::negate, result);
    }
    case Operation::arctangent:
        return over(da, plus(one, square(a)));
    case Operation::exponential:
        return times(id, da);
    case Operation::logarithm:
        return over(da, a);
    case Operation::add:
        return plus(da, db);
    case Operation::subtract:
        return minus(da, db);
    case Operation::multiply:
        return plus(times(da, b), times(a, db));
    case Operation::divide:
        return over(minus(da, times(id, db)), b);
    case Operation::power:
        return plus(times(times(b, power(a, minus(b, one))), da), times(times(id, unary(Operation::logarithm, a)), db));
    case Operation::minimum:
        return select(binary(Operation::less, b, a), db, da);
    case Operation::maximum:
        return select(binary(Operation::less, a, b), db, da);
    case Operation::arctangent2:
        return over(minus(times(b, da), times(a, db)), plus(square(a), square(b)));
    case Operation::over_length:
        // b itself is a length; both derivatives vanish with it.
        return binary(Operation::over_length, minus(da, times(id, db)), b);
    case Operation::length: {
        // The derivative at the tip of the cone is taken as 0, so that a wall at rest has one.
        const auto term = [&](NodeId x, NodeId dx) { return times(binary(Operation::over_length, x, id), dx); };
        return plus(plus(term(a, da), term(b, db)), term(c, dc));
    }
    case Operation::select:
        return select(a, db, dc);
    default:
        // sign and the comparisons: constant but for jumps.
        return constant(0);
    }
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
