#include <core/integrate/polynomial_degree.hpp>

#include <algorithm>
#include <vector>

namespace elvis {

namespace {

using Degree = std::optional<unsigned>;

/** A plugin's order, as a degree in collapsed coordinates: pyramids' modes may have twice the order along the third. */
unsigned collapsed_degree(unsigned order, elvis_shape shape) { return shape == ELVIS_SHAPE_PYRAMID ? 2 * order : order; }

class Degrees {
public:
    Degrees(const RuntimeVolume& volume, std::uint32_t element_class)
        : m_volume(volume), m_class(element_class), m_info(volume.classes()[element_class]) {}

    Degree of_leaf(const Node& node) const {
        switch (node.operation) {
        case Operation::constant:
        case Operation::order:
        case Operation::element:
            return 0;
        case Operation::position:
        case Operation::jacobian:
            return mapping_degree(m_volume, m_class);
        case Operation::inverse_jacobian:
            return m_info.is_affine ? Degree(0) : std::nullopt;
        case Operation::field:
            return of_field(node.field);
        case Operation::slope:
            return m_info.shape != ELVIS_SHAPE_PYRAMID ? of_field(node.field) : std::nullopt;
        case Operation::gradient:
        case Operation::hessian:
            return m_info.is_affine && m_info.shape != ELVIS_SHAPE_PYRAMID ? of_field(node.field) : std::nullopt;
        default:
            return std::nullopt;
        }
    }

private:
    Degree of_field(std::uint32_t field) const {
        const ClassFieldInfo info = m_volume.class_field(m_class, field);
        const bool is_whole = m_volume.fields()[field].transform == ELVIS_TRANSFORM_NONE || m_info.is_affine;
        const std::int32_t order = std::max({info.order[0], info.order[1], info.order[2]});
        return is_whole && order >= 0 ? Degree(collapsed_degree(static_cast<unsigned>(order), m_info.shape)) : std::nullopt;
    }

    const RuntimeVolume& m_volume;
    std::uint32_t m_class;
    const ClassInfo& m_info;
};

Degree of_operation(const Node& node, Degree a, Degree b) {
    switch (node.operation) {
    case Operation::negate:
        return a;
    case Operation::whole_power:
        return a ? Degree(*a * static_cast<unsigned>(node.number)) : a;
    case Operation::add:
    case Operation::subtract:
        return a && b ? Degree(std::max(*a, *b)) : std::nullopt;
    case Operation::multiply:
        return a && b ? Degree(*a + *b) : std::nullopt;
    default:
        // What has constant operands alone is constant.
        return a == 0u && (n_operands(node.operation) == 1 || (n_operands(node.operation) == 2 && b == 0u)) ? Degree(0)
                                                                                                            : std::nullopt;
    }
}

} // namespace

std::optional<unsigned> mapping_degree(const RuntimeVolume& volume, std::uint32_t element_class) {
    const ClassInfo& info = volume.classes()[element_class];
    const std::uint32_t order = std::max({info.geometry_order[0], info.geometry_order[1], info.geometry_order[2]});
    return order > 0 ? Degree(collapsed_degree(order, info.shape)) : std::nullopt;
}

std::optional<unsigned> polynomial_degree(const Expression& expression, const RuntimeVolume& volume,
                                          std::uint32_t element_class) {
    const Degrees degrees(volume, element_class);
    std::vector<Degree> of_nodes(expression.graph().size());
    for (const NodeId id : expression.graph().needed({expression.value()})) {
        const Node& node = expression.graph().node(id);
        const bool is_quotient = node.operation == Operation::divide && of_nodes[node.operands[1]] == 0u;
        of_nodes[id] = n_operands(node.operation) == 0 ? degrees.of_leaf(node)
                       : is_quotient                   ? of_nodes[node.operands[0]]
                                     : of_operation(node, of_nodes[node.operands[0]], of_nodes[node.operands[1]]);
    }
    return of_nodes[expression.value()];
}

} // namespace elvis
