/**
 * @file graph.hpp
 * An expression as a graph of scalar operations: equal parts are one node, constants are folded.
 *
 * Vectors are several nodes. A node's operands come before it, so the order of the nodes is an order of evaluation. Leaves are
 * what an element gives at a reference point xi; derivatives of the graph are nodes of the same graph, made by the chain rule,
 * with respect to a world coordinate or to a reference coordinate. With J_ij = dx_i/dxi_j, K its inverse, M_ijl = d2x_i/dxi_j
 * dxi_l, the world gradient of a field f is G_i = sum_j df/dxi_j K_ji, and
 *
 *     dG_i/dxi_l = sum_b K_bi C_bl,   C_bl = d2f/dxi_b dxi_l - sum_a G_a M_abl,   d2f/dx_i dx_j = sum_bl K_bi C_bl K_lj,
 *
 * from the derivative of K, dK = -K dJ K.
 */
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace elvis {

using NodeId = std::uint32_t;

enum class Operation : std::uint8_t {
    // Leaves.
    constant,         ///< number
    position,         ///< x_i, world
    field,            ///< component of a field
    slope,            ///< df/dxi_i
    gradient,         ///< df/dx_i
    bend,             ///< C_ij, symmetric: i <= j
    hessian,          ///< d2f/dx_i dx_j, symmetric: i <= j
    jacobian,         ///< J_ij
    inverse_jacobian, ///< K_ij
    mapping_hessian,  ///< M_ijl, symmetric in the last two: j <= l
    order,            ///< polynomial order of a field in the element, or with field = any_field the largest of all fields
    element,          ///< the element's number
    // One operand.
    negate,
    whole_power, ///< to `number`, whole, from 2 to 255
    power_to,    ///< to `number`, not whole
    square_root,
    absolute,
    sign,
    sine,
    cosine,
    tangent,
    arcsine,
    arccosine,
    arctangent,
    exponential,
    logarithm,
    // Two operands.
    add,
    subtract,
    multiply,
    divide,
    power,
    minimum,
    maximum,
    arctangent2,
    over_length, ///< a / b, and 0 where b is 0: a component of a vector over its length
    less,        ///< 1 or 0
    less_equal,
    equal,
    // Three operands.
    length,
    select ///< second operand where the first is not 0, else the third
};

inline constexpr std::uint32_t any_field = 0xffffffffu;

struct Node {
    Operation operation = Operation::constant;
    std::array<NodeId, 3> operands{};
    double number = 0;
    /** Of leaves. */
    std::uint32_t field = 0;
    std::uint32_t component = 0;
    std::array<std::uint8_t, 3> index{};

    friend auto operator<=>(const Node&, const Node&) = default; // NOLINT(modernize-use-nullptr): clang-tidy's own 0
};

std::size_t n_operands(Operation operation);

class Graph {
public:
    const Node& node(NodeId id) const { return m_nodes[id]; }
    std::size_t size() const { return m_nodes.size(); }

    NodeId constant(double number);
    NodeId leaf(Operation operation, std::uint8_t i = 0, std::uint8_t j = 0, std::uint8_t k = 0);
    NodeId field_leaf(Operation operation, std::uint32_t field, std::uint32_t component, std::uint8_t i = 0,
                      std::uint8_t j = 0);
    NodeId unary(Operation operation, NodeId a);
    NodeId binary(Operation operation, NodeId a, NodeId b);
    /** Whole powers by products, roots as roots. */
    NodeId power(NodeId a, NodeId b);
    NodeId length(NodeId a, NodeId b, NodeId c);
    NodeId select(NodeId condition, NodeId a, NodeId b);

    /** Derivative by world coordinate `axis`; none if it takes third derivatives of a field or of the mapping. */
    std::optional<NodeId> world_derivative(NodeId id, std::uint8_t axis) { return derivative(id, axis, true); }
    /** Derivative by reference coordinate `axis`; none likewise. */
    std::optional<NodeId> reference_derivative(NodeId id, std::uint8_t axis) { return derivative(id, axis, false); }

    /** The nodes that these need, in order of evaluation, themselves included. */
    std::vector<NodeId> needed(const std::vector<NodeId>& roots) const;

private:
    NodeId add(const Node& node);
    NodeId whole_power(NodeId a, std::uint32_t exponent);
    std::optional<double> number(NodeId id) const;
    bool is(NodeId id, double value) const;
    std::optional<NodeId> derivative(NodeId id, std::uint8_t axis, bool is_world);
    std::optional<NodeId> leaf_derivative(const Node& node, std::uint8_t axis, bool is_world);
    NodeId chain(NodeId id, const std::array<NodeId, 3>& derivatives);
    NodeId sum(const std::vector<NodeId>& terms);

    std::vector<Node> m_nodes;
    std::map<Node, NodeId> m_ids;
    std::map<std::array<std::uint32_t, 3>, std::optional<NodeId>> m_derivatives;
};

/** One operation on numbers, as C++ has it; leaves have no operands and are not among them. */
double apply(const Node& node, double a, double b, double c);

} // namespace elvis
