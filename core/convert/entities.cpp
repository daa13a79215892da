#include <core/convert/entities.hpp>

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

/** Gauss points of a quadrilateral, unchanged by its symmetries. */
void append_quadrilateral(GaussPoints& points, const std::array<native::Point, 4>& corners, const std::vector<double>& z,
                          const std::vector<double>& weights) {
    for (std::size_t j = 0; j < z.size(); ++j) {
        for (std::size_t i = 0; i < z.size(); ++i) {
            const double u = 0.5 * (1 + z[i]), v = 0.5 * (1 + z[j]);
            append(points, combine(combine(corners[0], corners[1], u), combine(corners[3], corners[2], u), v),
                   weights[i] * weights[j]);
        }
    }
}

/** Gauss points of a triangle, collapsed at each of its corners in turn: a neighbour may have another collapsed corner. */
void append_triangle(GaussPoints& points, const std::array<native::Point, 4>& corners, const std::vector<double>& z,
                     const std::vector<double>& weights) {
    for (std::size_t top = 0; top < 3; ++top) {
        for (std::size_t j = 0; j < z.size(); ++j) {
            for (std::size_t i = 0; i < z.size(); ++i) {
                const double u = 0.5 * (1 + z[i]), v = 0.5 * (1 + z[j]);
                append(points, combine(combine(corners[(top + 1) % 3], corners[(top + 2) % 3], u), corners[top], v),
                       weights[i] * weights[j] * (1 - v));
            }
        }
    }
}

/** Builds the projection one entity after the other. */
class Builder {
public:
    explicit Builder(const native::Space& space)
        : m_space(space), m_is_taken(native::n_modes(space), false), m_blocks(static_cast<Eigen::Index>(m_is_taken.size()), 0) {
    }

    /** Lets the modes that are new on an entity (all that are left, in the interior) fit what is left of the data there. */
    void add(const GaussPoints& points, bool takes_all) {
        const Eigen::MatrixXd at_points = mode_matrix(m_space, points.xi);
        std::vector<Eigen::Index> modes;
        for (Eigen::Index mode = 0; mode < at_points.cols(); ++mode) {
            const auto taken = m_is_taken.begin() + mode;
            if (!*taken && (takes_all || at_points.col(mode).cwiseAbs().maxCoeff() > vanishing)) {
                modes.push_back(mode);
                *taken = true;
            }
        }
        if (modes.empty()) {
            return;
        }
        const Eigen::Index n_points = at_points.rows();
        const Eigen::MatrixXd fit = fit_matrix(at_points(Eigen::all, modes), points.weights);

        // Data at the new points, less what the modes before make of the data before: [ -at_points * before | identity ].
        const Eigen::Index n_before = m_blocks.cols();
        Eigen::MatrixXd left(n_points, n_before + n_points);
        left.leftCols(n_before) = -at_points * m_blocks;
        left.rightCols(n_points).setIdentity();
        const Eigen::MatrixXd coefficients = fit * left;
        m_blocks.conservativeResize(Eigen::NoChange, n_before + n_points);
        m_blocks.rightCols(n_points).setZero();
        for (std::size_t index = 0; index < modes.size(); ++index) {
            m_blocks.row(modes[index]) = coefficients.row(static_cast<Eigen::Index>(index));
        }
        m_points.insert(m_points.end(), points.xi.begin(), points.xi.end());
    }

    PointProjection result() && { return {std::move(m_points), std::move(m_blocks)}; }

private:
    native::Space m_space;
    std::vector<bool> m_is_taken;
    PointList m_points;
    Eigen::MatrixXd m_blocks;
};

} // namespace

PointProjection entity_projection(const native::Space& space) {
    const native::Shape shape = space.shape;
    const std::array<std::uint32_t, 3> collapsed = native::collapsed_order(space);
    const std::uint32_t n = *std::max_element(collapsed.begin(), collapsed.end()) + 2;
    std::vector<double> z(n), weights(n);
    native::gauss_legendre(z, weights);

    Builder builder(space);
    for (int corner = 0; corner < native::n_corners(shape); ++corner) {
        GaussPoints points;
        append(points, native::corner(shape, corner), 1);
        builder.add(points, false);
    }
    for (const auto& [a, b] : edges(shape)) {
        GaussPoints points;
        for (std::size_t i = 0; i < n; ++i) {
            append(points, combine(native::corner(shape, a), native::corner(shape, b), 0.5 * (1 + z[i])), weights[i]);
        }
        builder.add(points, false);
    }
    for (int face = 0; face < native::n_faces(shape); ++face) {
        const std::span<const int> local = native::face_corners(shape, face);
        std::array<native::Point, 4> corners{};
        std::transform(local.begin(), local.end(), corners.begin(), [&](int k) { return native::corner(shape, k); });
        GaussPoints points;
        if (local.size() == 4) {
            append_quadrilateral(points, corners, z, weights);
        } else {
            append_triangle(points, corners, z, weights);
        }
        builder.add(points, false);
    }
    builder.add(gauss_points(shape, {n, n, n}), true);
    return std::move(builder).result();
}

} // namespace elvis
