#include "basis.hpp"

#include <Eigen/LU>

#include <cassert>

namespace elvis_cgns {

Basis::Basis(const ElementType& type) : m_type(type) {
    const std::vector<Point> nodes = elvis_cgns::nodes(type);
    const auto n = static_cast<Eigen::Index>(nodes.size());
    Eigen::MatrixXd at_nodes(n, n);
    for (Eigen::Index node = 0; node < n; ++node) {
        const std::vector<double> row = functions(type, nodes[static_cast<std::size_t>(node)]);
        assert(row.size() == nodes.size());
        at_nodes.row(node) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), n);
    }
    m_to_coefficients = at_nodes.partialPivLu().inverse();
}

std::array<std::uint32_t, 3> Basis::native_order() const {
    const auto order = static_cast<std::uint32_t>(m_type.order);
    return {order, order, dimension(m_type.topology) == 3 ? order : 0};
}

Matrix Basis::values(std::span<const double> xi) const {
    Matrix values(static_cast<Eigen::Index>(xi.size() / 3), m_to_coefficients.rows());
    for (Eigen::Index point = 0; point < values.rows(); ++point) {
        const std::vector<double> row =
            functions(m_type, source_point(m_type.topology, &xi[3 * static_cast<std::size_t>(point)]));
        values.row(point) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), values.cols());
    }
    return values * m_to_coefficients;
}

std::shared_ptr<const Matrix> Basis::at(std::span<const double> xi) const {
    return m_matrices.get({}, xi, [&] { return values(xi); });
}

void Bases::add(const ElementType& type) {
    if (!m_bases.contains(type)) {
        m_bases.emplace(type, std::make_unique<const Basis>(type));
    }
}

} // namespace elvis_cgns
