#include <core/expression/poles.hpp>

#include <core/expression/evaluate.hpp>
#include <core/expression/volume_point.hpp>

#include <elvis/native/space.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace elvis {

namespace {

/** Of a node's size elsewhere in the element; and of what a root is of, which falls faster than the root. */
constexpr double almost_zero = 1e-5, almost_zero_below_root = 1e-6;
/** Of the way to the element's corners. */
constexpr double elsewhere = 0.3;

/** Values of all nodes at a place, and largest ones around it. */
class NodeSizes {
public:
    NodeSizes(const Expression& expression, const RuntimeVolume& volume, std::uint32_t time_step, std::uint64_t element,
              const Vector3& xi)
        : m_here(values(expression, volume, time_step, element, xi)), m_around(m_here.size()) {
        std::uint32_t index = 0;
        while (element >= volume.classes()[index].first_element + volume.classes()[index].n_elements) {
            ++index;
        }
        const auto shape = static_cast<native::Shape>(volume.classes()[index].shape);
        for (int corner = 0; corner < native::n_corners(shape); ++corner) {
            const native::Point to = native::corner(shape, corner);
            const Vector3 there = plus(scaled(xi, 1 - elsewhere), scaled({to[0], to[1], to[2]}, elsewhere));
            const std::vector<double> found = values(expression, volume, time_step, element, there);
            for (std::size_t node = 0; node < found.size(); ++node) {
                m_around[node] = std::max(m_around[node], std::abs(found[node]));
            }
        }
    }
    double here(NodeId node) const { return m_here[node]; }
    bool is_below(double share, NodeId node) const { return std::abs(m_here[node]) < share * m_around[node]; }

private:
    static std::vector<double> values(const Expression& expression, const RuntimeVolume& volume, std::uint32_t time_step,
                                      std::uint64_t element, const Vector3& xi) {
        VolumePoint point(volume, element, xi, time_step);
        return node_values(expression, point);
    }

    std::vector<double> m_here, m_around;
};

} // namespace

bool is_near_pole(const Expression& expression, const RuntimeVolume& volume, std::uint32_t time_step, std::uint64_t element,
                  const Vector3& xi) {
    const NodeSizes sizes(expression, volume, time_step, element, xi);
    const auto is_almost_zero = [&](NodeId id) {
        const Node& node = expression.graph().node(id);
        return node.operation == Operation::square_root ? sizes.is_below(almost_zero_below_root, node.operands[0])
                                                        : sizes.is_below(almost_zero, id);
    };
    const auto has_pole = [&](NodeId id) {
        const Node& node = expression.graph().node(id);
        const auto [a, b, c] = node.operands;
        switch (node.operation) {
        case Operation::divide:
            return is_almost_zero(b) && !is_almost_zero(a);
        case Operation::logarithm:
            return is_almost_zero(a);
        case Operation::power_to:
            return node.number < 0 && is_almost_zero(a);
        case Operation::power:
            return sizes.here(b) < 0 && is_almost_zero(a);
        case Operation::tangent:
            return std::abs(std::cos(sizes.here(a))) < almost_zero;
        default:
            return false;
        }
    };
    return std::ranges::any_of(expression.graph().needed({expression.value()}), has_pole);
}

} // namespace elvis
