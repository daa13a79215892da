#include <core/expression/evaluate.hpp>

#include <core/base/vector3.hpp>

#include <cassert>
#include <map>
#include <optional>
#include <utility>

namespace elvis {

namespace {

/** Values of leaves; what several leaves share is asked for once. */
class Leaves {
public:
    explicit Leaves(ExpressionPoint& point) : m_point(point) {}

    double value(const Node& node) {
        const auto [i, j, k] = node.index;
        const auto entry = [](std::uint8_t row, std::uint8_t column) { return std::size_t{3} * row + column; };
        switch (node.operation) {
        case Operation::constant:
            return node.number;
        case Operation::position:
            return keep(m_position, [&] { return m_point.position(); })[i];
        case Operation::field:
            return m_point.value(node.field, node.component);
        case Operation::slope:
            return slopes(node)[i];
        case Operation::gradient:
            return gradient(node, i);
        case Operation::bend:
            return bend(node, i, j);
        case Operation::hessian: {
            double sum = 0;
            for (std::uint8_t b = 0; b < 3; ++b) {
                for (std::uint8_t l = 0; l < 3; ++l) {
                    sum += inverse()[entry(b, i)] * bend(node, b, l) * inverse()[entry(l, j)];
                }
            }
            return sum;
        }
        case Operation::jacobian:
            return jacobian()[entry(i, j)];
        case Operation::inverse_jacobian:
            return inverse()[entry(i, j)];
        case Operation::mapping_hessian:
            return mapping_hessian()[9 * i + entry(j, k)];
        case Operation::order:
            return m_point.order(node.field);
        case Operation::element:
            return m_point.element_number();
        default:
            assert(false && "not a leaf");
            return 0;
        }
    }

private:
    template <class Kept, class Function> static const Kept& keep(std::optional<Kept>& kept, const Function& function) {
        if (!kept) {
            kept = function();
        }
        return *kept;
    }
    const std::array<double, 9>& jacobian() {
        return keep(m_jacobian, [&] { return m_point.jacobian(); });
    }
    const std::array<double, 9>& inverse() {
        return keep(m_inverse, [&] { return inverse3(jacobian()); });
    }
    const std::array<double, 27>& mapping_hessian() {
        return keep(m_mapping_hessian, [&] { return m_point.mapping_hessian(); });
    }
    const Vector3& slopes(const Node& node) {
        return keep(m_slopes[{node.field, node.component}], [&] { return m_point.gradient(node.field, node.component); });
    }
    double gradient(const Node& node, std::size_t i) {
        const Vector3& slope = slopes(node);
        return slope[0] * inverse()[i] + slope[1] * inverse()[3 + i] + slope[2] * inverse()[6 + i];
    }
    double bend(const Node& node, std::size_t b, std::size_t l) {
        double sum = keep(m_hessians[{node.field, node.component}],
                          [&] { return m_point.hessian(node.field, node.component); })[3 * b + l];
        for (std::size_t a = 0; a < 3; ++a) {
            sum -= gradient(node, a) * mapping_hessian()[9 * a + 3 * b + l];
        }
        return sum;
    }

    using Key = std::pair<std::uint32_t, std::uint32_t>;
    ExpressionPoint& m_point;
    std::optional<Vector3> m_position;
    std::optional<std::array<double, 9>> m_jacobian, m_inverse;
    std::optional<std::array<double, 27>> m_mapping_hessian;
    std::map<Key, std::optional<Vector3>> m_slopes;
    std::map<Key, std::optional<std::array<double, 9>>> m_hessians;
};

std::vector<double> evaluate_nodes(const Graph& graph, const std::vector<NodeId>& roots, ExpressionPoint& point) {
    Leaves leaves(point);
    std::vector<double> values(graph.size());
    for (const NodeId id : graph.needed(roots)) {
        const Node& node = graph.node(id);
        const auto [a, b, c] = node.operands;
        values[id] = n_operands(node.operation) == 0 ? leaves.value(node) : apply(node, values[a], values[b], values[c]);
    }
    return values;
}

/** A point of space, where there is no element. */
class SpacePoint : public ExpressionPoint {
public:
    explicit SpacePoint(const Vector3& x) : m_x(x) {}
    Vector3 position() override { return m_x; }
    std::array<double, 9> jacobian() override { return {}; }
    std::array<double, 27> mapping_hessian() override { return {}; }
    double value(std::uint32_t, std::uint32_t) override { return 0; }
    Vector3 gradient(std::uint32_t, std::uint32_t) override { return {}; }
    std::array<double, 9> hessian(std::uint32_t, std::uint32_t) override { return {}; }
    double order(std::uint32_t) override { return 0; }
    double element_number() override { return 0; }

private:
    Vector3 m_x;
};

} // namespace

std::vector<double> node_values(const Expression& expression, ExpressionPoint& point) {
    return evaluate_nodes(expression.graph(), {expression.value()}, point);
}

std::array<double, 9> inverse3(const std::array<double, 9>& m) {
    const auto minor = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) { return m[a] * m[d] - m[b] * m[c]; };
    const std::array<double, 9> adjugate{minor(4, 5, 7, 8), minor(2, 1, 8, 7), minor(1, 2, 4, 5),
                                         minor(5, 3, 8, 6), minor(0, 2, 6, 8), minor(2, 0, 5, 3),
                                         minor(3, 4, 6, 7), minor(1, 0, 7, 6), minor(0, 1, 3, 4)};
    const double determinant = m[0] * adjugate[0] + m[1] * adjugate[3] + m[2] * adjugate[6];
    std::array<double, 9> inverse{};
    for (std::size_t i = 0; i < 9; ++i) {
        inverse[i] = adjugate[i] / determinant;
    }
    return inverse;
}

double evaluate(const Expression& expression, ExpressionPoint& point) {
    return evaluate_nodes(expression.graph(), {expression.value()}, point)[expression.value()];
}

ValueAndGradient evaluate_gradient(const Expression& expression, ExpressionPoint& point) {
    const auto [d0, d1, d2] = expression.gradient().value();
    const std::vector<double> values = evaluate_nodes(expression.graph(), {expression.value(), d0, d1, d2}, point);
    return {values[expression.value()], {values[d0], values[d1], values[d2]}};
}

ValueAndGradient evaluate_implicit(const Expression& expression, const Vector3& x) {
    SpacePoint point(x);
    return evaluate_gradient(expression, point);
}

} // namespace elvis
