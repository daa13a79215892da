#include <core/convert/entities.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <set>

namespace elvis {

namespace {

/** A mode that is smaller than this everywhere on an entity vanishes there; modes are of size one. */
constexpr double vanishing = 1e-12;

native::Point combine(const native::Point& a, const native::Point& b, double weight_of_b) {
    native::Point result{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        result[axis] = (1 - weight_of_b) * a[axis] + weight_of_b * b[axis];
    }
    return result;
}

void append(GaussPoints& points, const native::Point& xi, double weight) {
    points.xi.insert(points.xi.end(), xi.begin(), xi.end());
    points.weights.push_back(weight);
}

/** Pairs of corners that bound an edge: consecutive corners of some face. */
std::set<std::pair<int, int>> edges(native::Shape shape) {
    std::set<std::pair<int, int>> result;
    for (int face = 0; face < native::n_faces(shape); ++face) {
        const std::span<const int> corners = native::face_corners(shape, face);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const int a = corners[k], b = corners[(k + 1) % corners.size()];
            result.emplace(std::min(a, b), std::max(a, b));
        }
    }
    return result;
}

/** Gauss points on a face; a triangle is collapsed at its last corner, where the shape's own coordinates collapse. */
GaussPoints face_gauss(native::Shape shape, int face, std::uint32_t n) {
    std::vector<double> z(n), weights(n);
    native::gauss_legendre(z, weights);
    const std::span<const int> corners = native::face_corners(shape, face);
    const bool is_triangle = corners.size() == 3;
    GaussPoints points;
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i < n; ++i) {
            const double u = 0.5 * (1 + z[i]), v = 0.5 * (1 + z[j]);
            const native::Point bottom = combine(native::corner(shape, corners[0]), native::corner(shape, corners[1]), u);
            const native::Point top = is_triangle
                                          ? native::corner(shape, corners[2])
                                          : combine(native::corner(shape, corners[3]), native::corner(shape, corners[2]), u);
            append(points, combine(bottom, top, v), weights[i] * weights[j] * (is_triangle ? 1 - v : 1));
        }
    }
    return points;
}

} // namespace

EntityProjector::EntityProjector(const native::Space& space) : m_n_modes(static_cast<Eigen::Index>(native::n_modes(space))) {
    const native::Shape shape = space.shape;
    const std::uint32_t n = *std::max_element(space.order.begin(), space.order.end()) + 2;
    std::vector<bool> is_taken(static_cast<std::size_t>(m_n_modes), false);
    for (int corner = 0; corner < native::n_corners(shape); ++corner) {
        GaussPoints point;
        append(point, native::corner(shape, corner), 1);
        add_entity(space, point, is_taken, false);
    }
    std::vector<double> z(n), weights(n);
    native::gauss_legendre(z, weights);
    for (const auto& [a, b] : edges(shape)) {
        GaussPoints points;
        for (std::size_t i = 0; i < n; ++i) {
            append(points, combine(native::corner(shape, a), native::corner(shape, b), 0.5 * (1 + z[i])), weights[i]);
        }
        add_entity(space, points, is_taken, false);
    }
    if (native::dimension(shape) == 3) {
        for (int face = 0; face < native::n_faces(shape); ++face) {
            add_entity(space, face_gauss(shape, face, n), is_taken, false);
        }
    }
    add_entity(space, gauss_points(shape, {n, n, n}), is_taken, true);
}

void EntityProjector::add_entity(const native::Space& space, const GaussPoints& points, std::vector<bool>& is_taken,
                                 bool takes_all) {
    Entity entity;
    entity.first_point = static_cast<Eigen::Index>(m_points.size() / 3);
    entity.n_points = static_cast<Eigen::Index>(points.weights.size());
    entity.at_points = mode_matrix(space, points.xi);
    for (Eigen::Index mode = 0; mode < m_n_modes; ++mode) {
        const auto taken = is_taken.begin() + mode;
        if (!*taken && (takes_all || entity.at_points.col(mode).cwiseAbs().maxCoeff() > vanishing)) {
            entity.modes.push_back(mode);
            *taken = true;
        }
    }
    if (entity.modes.empty()) {
        return;
    }
    m_points.insert(m_points.end(), points.xi.begin(), points.xi.end());
    const Eigen::VectorXd root = Eigen::Map<const Eigen::VectorXd>(points.weights.data(), entity.n_points).cwiseSqrt();
    const Eigen::MatrixXd own = root.asDiagonal() * entity.at_points(Eigen::all, entity.modes);
    entity.to_modes =
        Eigen::MatrixXd(own.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(entity.n_points, entity.n_points))) *
        root.asDiagonal();
    m_entities.push_back(std::move(entity));
}

Eigen::MatrixXd EntityProjector::project(const Eigen::Ref<const Eigen::MatrixXd>& values) const {
    Eigen::MatrixXd coefficients = Eigen::MatrixXd::Zero(m_n_modes, values.cols());
    for (const Entity& entity : m_entities) {
        const Eigen::MatrixXd left = values.middleRows(entity.first_point, entity.n_points) - entity.at_points * coefficients;
        const Eigen::MatrixXd own = entity.to_modes * left;
        for (std::size_t index = 0; index < entity.modes.size(); ++index) {
            coefficients.row(entity.modes[index]) = own.row(static_cast<Eigen::Index>(index));
        }
    }
    return coefficients;
}

} // namespace elvis
