#include "nodal_space.hpp"

#include <Eigen/LU>

#include <stdexcept>
#include <string>

namespace elvis::nodal {

namespace {

/**
 * Largest error of the functions at the nodes themselves: nodes that determine them leave rounding, times the matrix's
 * condition, which is 1e9 for equidistant nodes of order 12 in hexahedra.
 */
constexpr double most_misfit = 1e-6;

} // namespace

native::Space space_of_order(native::Shape shape, std::uint32_t order) {
    native::Space space{shape, native::Basis::orthogonal, {order, order, order}};
    if (native::dimension(shape) == 2) {
        space.order[2] = 0;
    }
    return space;
}

std::size_t n_functions(native::Shape shape, std::uint32_t order) { return native::n_modes(space_of_order(shape, order)); }

int order_of(native::Shape shape, std::size_t n, std::uint32_t most) {
    for (std::uint32_t order = 0; order <= most; ++order) {
        if (n_functions(shape, order) == n) {
            return static_cast<int>(order);
        }
    }
    return -1;
}

NodalSpace::NodalSpace(native::Shape shape, std::uint32_t order, std::vector<double> nodes)
    : m_space(space_of_order(shape, order)), m_order(order), m_nodes(std::move(nodes)) {
    const std::size_t n = native::n_modes(m_space);
    if (m_nodes.size() != 3 * n) {
        throw std::invalid_argument(std::to_string(m_nodes.size() / 3) + " points where " + std::to_string(n) +
                                    " determine the polynomials of order " + std::to_string(order));
    }
    const Eigen::MatrixXd at_nodes = modes(m_nodes);
    m_to_modes = at_nodes.partialPivLu().inverse();
    const double misfit =
        (at_nodes * m_to_modes - Eigen::MatrixXd::Identity(at_nodes.rows(), at_nodes.cols())).cwiseAbs().maxCoeff();
    if (!m_to_modes.allFinite() || !(misfit < most_misfit)) {
        throw std::invalid_argument("points that do not determine the polynomials of order " + std::to_string(order));
    }
}

Matrix NodalSpace::modes(std::span<const double> xi) const {
    Matrix values(static_cast<Eigen::Index>(xi.size() / 3), static_cast<Eigen::Index>(native::n_modes(m_space)));
    for (Eigen::Index point = 0; point < values.rows(); ++point) {
        const double* const x = &xi[3 * static_cast<std::size_t>(point)];
        native::evaluate_modes(m_space, {x[0], x[1], x[2]},
                               std::span(values.row(point).data(), static_cast<std::size_t>(values.cols())));
    }
    return values;
}

std::shared_ptr<const Matrix> NodalSpace::at(std::span<const double> xi) const {
    return m_matrices.get({}, xi, [&]() -> Matrix { return modes(xi) * m_to_modes; });
}

std::shared_ptr<const NodalSpace> NodalSpaces::get(native::Shape shape, std::uint32_t order, std::vector<double> nodes) {
    const std::lock_guard lock(m_mutex);
    for (const auto& space : m_spaces) {
        if (space->shape() == shape && space->order() == order && space->nodes() == nodes) {
            return space;
        }
    }
    m_spaces.push_back(std::make_shared<const NodalSpace>(shape, order, std::move(nodes)));
    return m_spaces.back();
}

} // namespace elvis::nodal
