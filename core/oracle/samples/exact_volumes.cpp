#include "exact_volumes.hpp"

#include <cmath>
#include <numbers>

namespace elvis::oracle {

using native::Shape;

Fit::Fit(const native::Space& space) {
    const auto n_modes = static_cast<Eigen::Index>(native::n_modes(space));
    // More Chebyshev nodes than modes, inside the collapsed cube.
    const auto degree = native::collapsed_order(space);
    const auto node = [](std::uint32_t i, std::uint32_t n) {
        return -std::cos(std::numbers::pi * (2.0 * i + 1) / (2.0 * n + 2));
    };
    for (std::uint32_t k = 0; k <= degree[2] + 1; ++k)
        for (std::uint32_t j = 0; j <= degree[1] + 1; ++j)
            for (std::uint32_t i = 0; i <= degree[0] + 1; ++i) {
                const native::Point xi =
                    native::expand(space.shape, {node(i, degree[0] + 1), node(j, degree[1] + 1), node(k, degree[2] + 1)});
                m_points.emplace_back(xi[0], xi[1], xi[2]);
            }
    Eigen::MatrixXd modes(static_cast<Eigen::Index>(m_points.size()), n_modes);
    std::vector<double> row(static_cast<std::size_t>(n_modes));
    for (Eigen::Index i = 0; i < modes.rows(); ++i) {
        const Vector& xi = m_points[static_cast<std::size_t>(i)];
        native::evaluate_modes(space, {xi.x(), xi.y(), xi.z()}, row);
        modes.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), n_modes);
    }
    m_modes.compute(modes);
}

std::vector<double> Fit::operator()(const std::function<double(const Vector& xi)>& function) const {
    Eigen::VectorXd values(static_cast<Eigen::Index>(m_points.size()));
    for (Eigen::Index i = 0; i < values.size(); ++i)
        values[i] = function(m_points[static_cast<std::size_t>(i)]);
    const Eigen::VectorXd coefficients = m_modes.solve(values);
    return {coefficients.begin(), coefficients.end()};
}

native::Space space_of(Shape shape, std::uint32_t order) {
    const native::Basis basis = shape == Shape::pyramid ? native::Basis::tensor : native::Basis::modified;
    return {shape, basis, {order, order, native::dimension(shape) == 2 ? 0 : order}};
}

ClassData make_class(const native::Space& geometry, const native::Space& field, const std::vector<Map>& maps,
                     const Function& function, std::int64_t first_number) {
    ClassData data;
    data.geometry = geometry;
    data.field = field;
    const Fit fit_geometry(geometry);
    const Fit fit_field(field);
    for (const Map& map : maps) {
        for (Eigen::Index d = 0; d < 3; ++d) {
            const std::vector<double> c = fit_geometry([&](const Vector& xi) { return map(xi)[d]; });
            data.geometry_coefficients.insert(data.geometry_coefficients.end(), c.begin(), c.end());
        }
        const std::vector<double> c = fit_field([&](const Vector& xi) { return function(map(xi)); });
        data.field_coefficients.insert(data.field_coefficients.end(), c.begin(), c.end());
        data.numbers.push_back(first_number++);
    }
    return data;
}

std::vector<Map> boxes(const Vector& lower, const Vector& upper, const std::array<int, 3>& n) {
    std::vector<Map> maps;
    for (int k = 0; k < n[2]; ++k)
        for (int j = 0; j < n[1]; ++j)
            for (int i = 0; i < n[0]; ++i)
                maps.push_back([=](const Vector& xi) -> Vector {
                    const Vector corner(i, j, k);
                    const Vector fraction = (corner + 0.5 * (xi + Vector::Ones())).cwiseQuotient(Vector(n[0], n[1], n[2]));
                    return lower + fraction.cwiseProduct(upper - lower);
                });
    return maps;
}

Map twisted_tetrahedron(const Vector& displacement) {
    return [displacement](const Vector& xi) -> Vector {
        const Vector b = 0.5 * (xi + Vector::Ones());
        const double b0 = 1 - b.sum();
        // Quadratic shape function of the edge's middle.
        return b + 4 * b0 * b.x() * displacement;
    };
}

} // namespace elvis::oracle
