#include "linear_element.hpp"

#include <cmath>
#include <limits>

namespace elvis::nodal {

namespace {

/** Nodes that mesh generators interpolate are off by some units in the last place of the coordinates. */
constexpr double tolerance = 32 * std::numeric_limits<double>::epsilon();

Matrix corner_functions(const NodalSpace& space) {
    const native::Shape shape = space.shape();
    const native::Space linear{shape, native::Basis::modified, {1, 1, native::dimension(shape) == 3 ? 1u : 0u}};
    const auto n = static_cast<Eigen::Index>(native::n_modes(linear));
    const auto modes_at = [&](const native::Point& xi) {
        Eigen::RowVectorXd modes(n);
        native::evaluate_modes(linear, xi, std::span(modes.data(), static_cast<std::size_t>(n)));
        return modes;
    };
    // Each mode is 1 at one corner and 0 at the others: this is a permutation.
    Eigen::MatrixXd at_corners(n, n);
    for (Eigen::Index corner = 0; corner < n; ++corner) {
        at_corners.row(corner) = modes_at(native::corner(shape, static_cast<int>(corner)));
    }
    Matrix values(static_cast<Eigen::Index>(space.size()), n);
    for (Eigen::Index node = 0; node < values.rows(); ++node) {
        const double* const x = &space.nodes()[3 * static_cast<std::size_t>(node)];
        values.row(node) = modes_at({x[0], x[1], x[2]}) * at_corners.transpose();
    }
    return values;
}

} // namespace

LinearElement::LinearElement(const NodalSpace& nodes, std::vector<std::size_t> corners)
    : m_shape(nodes.shape()), m_corners(std::move(corners)), m_functions(corner_functions(nodes)) {}

bool LinearElement::operator()(const double* positions) const {
    const Eigen::Map<const Matrix> nodes(positions, m_functions.rows(), 3);
    Matrix corners(m_functions.cols(), 3);
    for (Eigen::Index corner = 0; corner < corners.rows(); ++corner) {
        corners.row(corner) = nodes.row(static_cast<Eigen::Index>(m_corners[static_cast<std::size_t>(corner)]));
    }
    const double bound = tolerance * nodes.cwiseAbs().maxCoeff();
    // The native linear pyramid has a rational function, which is needed unless the base is a parallelogram.
    const bool is_affine = m_shape != native::Shape::pyramid ||
                           (corners.row(0) - corners.row(1) + corners.row(2) - corners.row(3)).cwiseAbs().maxCoeff() <= bound;
    return is_affine && (m_functions * corners - nodes).cwiseAbs().maxCoeff() <= bound;
}

std::vector<std::size_t> corner_nodes(native::Shape shape, std::span<const double> nodes) {
    // Points of files are right to about 15 digits, other nodes are farther away.
    constexpr double near = 1e-6;
    std::vector<std::size_t> corners;
    for (int corner = 0; corner < native::n_corners(shape); ++corner) {
        const native::Point xi = native::corner(shape, corner);
        for (std::size_t node = 0; node < nodes.size() / 3; ++node) {
            const double* const x = &nodes[3 * node];
            if (std::abs(x[0] - xi[0]) < near && std::abs(x[1] - xi[1]) < near && std::abs(x[2] - xi[2]) < near) {
                corners.push_back(node);
                break;
            }
        }
    }
    const bool is_complete = corners.size() == static_cast<std::size_t>(native::n_corners(shape));
    return is_complete ? corners : std::vector<std::size_t>{};
}

} // namespace elvis::nodal
