#include <core/convert/topology/entities.hpp>

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
        : m_space(space), m_matrix(static_cast<Eigen::Index>(native::n_modes(space)), 0) {}

    /** Lets the modes that are new on a corner, edge or face fit what is left of the data there. */
    void add(const GaussPoints& points) {
        const Eigen::MatrixXd at_points = mode_matrix(m_space, points.xi);
        std::vector<Eigen::Index> modes;
        for (const Eigen::Index mode : others(m_done)) {
            if (at_points.col(mode).cwiseAbs().maxCoeff() > vanishing) {
                modes.push_back(mode);
            }
        }
        if (!modes.empty()) {
            add(points.xi, at_points, modes, fit_matrix(at_points(Eigen::all, modes), points.weights));
        }
    }

    /** The same in the interior, where all modes that are left are new. */
    void add_interior(const GaussPoints& points, const std::array<std::uint32_t, 3>& n) {
        const std::vector<Eigen::Index> modes = others(m_done);
        if (modes.empty()) {
            return;
        }
        const Eigen::MatrixXd at_points = mode_matrix(m_space, points.xi);
        const bool is_product = m_space.shape == native::Shape::hexahedron;
        add(points.xi, at_points, modes,
            is_product ? bubble_projection(m_space, n) : fit_matrix(at_points(Eigen::all, modes), points.weights));
    }

    PointProjection result() && { return {std::move(m_points), std::move(m_matrix)}; }

private:
    /** Modes that are not in a list, ascending. */
    std::vector<Eigen::Index> others(const std::vector<Eigen::Index>& list) const {
        std::vector<Eigen::Index> result;
        for (Eigen::Index mode = 0; mode < m_matrix.rows(); ++mode) {
            if (std::ranges::find(list, mode) == list.end()) {
                result.push_back(mode);
            }
        }
        return result;
    }

    void add(const PointList& xi, const Eigen::MatrixXd& at_points, const std::vector<Eigen::Index>& modes,
             const Eigen::MatrixXd& fit) {
        // The fit of the data at the new points, less that of what the modes before make of the data before.
        const Eigen::Index n_before = m_matrix.cols();
        m_matrix.conservativeResize(Eigen::NoChange, n_before + at_points.rows());
        m_matrix.rightCols(at_points.rows()).setZero();
        const Eigen::MatrixXd of_modes_before = fit * at_points(Eigen::all, m_done);
        const Eigen::MatrixXd of_data_before = -of_modes_before * m_matrix(m_done, Eigen::seqN(0, n_before));
        for (std::size_t index = 0; index < modes.size(); ++index) {
            m_matrix.row(modes[index]) << of_data_before.row(static_cast<Eigen::Index>(index)),
                fit.row(static_cast<Eigen::Index>(index));
        }
        m_done.insert(m_done.end(), modes.begin(), modes.end());
        m_points.insert(m_points.end(), xi.begin(), xi.end());
    }

    native::Space m_space;
    std::vector<Eigen::Index> m_done;
    PointList m_points;
    Eigen::MatrixXd m_matrix;
};

} // namespace

PointProjection entity_projection(const native::Space& space) {
    const native::Shape shape = space.shape;
    // The same number on a face whatever shape it belongs to, for elements of the same order.
    const std::uint32_t n = *std::max_element(space.order.begin(), space.order.end()) + 2;
    std::vector<double> z(n), weights(n);
    native::gauss_legendre(z, weights);

    Builder builder(space);
    for (int corner = 0; corner < native::n_corners(shape); ++corner) {
        GaussPoints points;
        append(points, native::corner(shape, corner), 1);
        builder.add(points);
    }
    for (const auto& [a, b] : edges(shape)) {
        GaussPoints points;
        for (std::size_t i = 0; i < n; ++i) {
            append(points, combine(native::corner(shape, a), native::corner(shape, b), 0.5 * (1 + z[i])), weights[i]);
        }
        builder.add(points);
    }
    for (int face = 0; face < native::n_faces(shape) && native::dimension(shape) == 3; ++face) {
        const std::span<const int> local = native::face_corners(shape, face);
        std::array<native::Point, 4> corners{};
        std::transform(local.begin(), local.end(), corners.begin(), [&](int k) { return native::corner(shape, k); });
        GaussPoints points;
        if (local.size() == 4) {
            append_quadrilateral(points, corners, z, weights);
        } else {
            append_triangle(points, corners, z, weights);
        }
        builder.add(points);
    }
    std::array<std::uint32_t, 3> inside = native::collapsed_order(space);
    for (std::uint32_t& direction : inside) {
        direction += 2;
    }
    builder.add_interior(gauss_points(shape, inside), inside);
    return std::move(builder).result();
}

} // namespace elvis
