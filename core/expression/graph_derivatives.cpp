// Derivatives of nodes: those of leaves, and the chain rule.
#include <core/expression/graph.hpp>

namespace elvis {

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

} // namespace elvis
