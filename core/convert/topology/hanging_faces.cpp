#include <core/base/vector3.hpp>
#include <core/convert/topology/grid_cell.hpp>
#include <core/convert/topology/hanging_faces.hpp>

#include <algorithm>
#include <limits>

namespace elvis {

namespace {

/** An unpaired face as a map from (u, v): the unit square, the triangle u, v >= 0, u + v <= 1, or the edge 0 <= u <= 1. */
class OpenFace {
public:
    OpenFace(const SourceVolume& source, const Topology& topology, FaceSide side)
        : m_source(&source), m_element(side / 8), m_shape(static_cast<native::Shape>(topology.shapes[m_element])),
          m_corners(native::face_corners(m_shape, static_cast<int>(side % 8))) {
        m_lower.fill(std::numeric_limits<double>::infinity());
        m_upper.fill(-std::numeric_limits<double>::infinity());
        for (double u : {0.0, 0.5, 1.0}) {
            for (double v : {0.0, 0.5, 1.0}) {
                if (is_inside(u, v)) {
                    const Vector3 x = at(u, v);
                    for (std::size_t axis = 0; axis < 3; ++axis) {
                        m_lower[axis] = std::min(m_lower[axis], x[axis]);
                        m_upper[axis] = std::max(m_upper[axis], x[axis]);
                    }
                }
            }
        }
        m_size = std::max({m_upper[0] - m_lower[0], m_upper[1] - m_lower[1], m_upper[2] - m_lower[2]});
        // Curved faces bulge out of the box of nine points, by less than their size.
        for (std::size_t axis = 0; axis < 3; ++axis) {
            m_lower[axis] -= 0.25 * m_size;
            m_upper[axis] += 0.25 * m_size;
        }
        m_centre = is_triangle() ? at(1.0 / 3, 1.0 / 3) : at(0.5, 0.5);
    }

    const Vector3& lower() const { return m_lower; }
    const Vector3& upper() const { return m_upper; }
    const Vector3& centre() const { return m_centre; }
    double size() const { return m_size; }

    /** Whether a point lies on the face, inside its rim. Gauss-Newton on |x(u, v) - point|^2 with differences for derivatives.
     */
    bool covers(const Vector3& point, double tolerance) const {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (point[axis] < m_lower[axis] || point[axis] > m_upper[axis]) {
                return false;
            }
        }
        constexpr double h = 1e-6;
        // Below this part of its size a face of another element is the same surface: geometry is given to 8 digits or more.
        const double near = std::max(tolerance, 1e-6 * m_size);
        double u = is_triangle() ? 1.0 / 3 : 0.5, v = u;
        for (int iteration = 0; iteration < 20; ++iteration) {
            const Vector3 x = at(u, v);
            const Vector3 left = minus(point, x);
            const bool is_near = dot(left, left) <= near * near;
            const Vector3 along_u = minus(at(u + h, v), x), along_v = minus(at(u, v + h), x);
            const double a = dot(along_u, along_u), b = dot(along_u, along_v), c = dot(along_v, along_v);
            const double determinant = is_edge() ? a : a * c - b * b;
            if (is_near || determinant <= 0) {
                return is_near && is_inside(u, v);
            }
            const double f = dot(along_u, left), g = dot(along_v, left);
            if (is_edge()) {
                u = std::clamp(u + h * f / a, -0.5, 1.5);
                continue;
            }
            u = std::clamp(u + h * (c * f - b * g) / determinant, -0.5, 1.5);
            v = std::clamp(v + h * (a * g - b * f) / determinant, -0.5, 1.5);
        }
        return false;
    }

private:
    bool is_triangle() const { return m_corners.size() == 3; }
    bool is_edge() const { return m_corners.size() == 2; }
    bool is_inside(double u, double v) const { return u >= 0 && v >= 0 && (is_triangle() ? u + v <= 1 : u <= 1 && v <= 1); }

    Vector3 at(double u, double v) const {
        std::array<double, 4> weights{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
        if (is_triangle()) {
            weights = {1 - u - v, u, v, 0};
        } else if (is_edge()) {
            weights = {1 - u, u, 0, 0};
        }
        native::Point xi{};
        for (std::size_t k = 0; k < m_corners.size(); ++k) {
            const native::Point corner = native::corner(m_shape, m_corners[k]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                xi[axis] += weights[k] * corner[axis];
            }
        }
        Vector3 x{};
        m_source->evaluate_mapping(m_element, xi, x);
        return x;
    }

    const SourceVolume* m_source;
    std::uint64_t m_element;
    native::Shape m_shape;
    std::span<const int> m_corners;
    Vector3 m_lower{};
    Vector3 m_upper{};
    Vector3 m_centre{};
    double m_size = 0;
};

/** Faces by the cells of a grid that their boxes meet. */
class Grid {
public:
    explicit Grid(const std::vector<OpenFace>& faces) {
        for (const OpenFace& face : faces) {
            m_cell += face.size() / static_cast<double>(faces.size());
        }
        // All faces shrunk to points: any cell will do.
        m_cell = m_cell > 0 ? m_cell : 1;
        for (std::uint32_t index = 0; index < faces.size(); ++index) {
            const auto low = cell_of(faces[index].lower(), m_cell), high = cell_of(faces[index].upper(), m_cell);
            for (std::int64_t i = low[0]; i <= high[0]; ++i) {
                for (std::int64_t j = low[1]; j <= high[1]; ++j) {
                    for (std::int64_t k = low[2]; k <= high[2]; ++k) {
                        m_faces[hash_of({i, j, k})].push_back(index);
                    }
                }
            }
        }
    }

    /** Faces that may cover a point. */
    const std::vector<std::uint32_t>& at(const Vector3& point) const {
        static const std::vector<std::uint32_t> none;
        const auto found = m_faces.find(hash_of(cell_of(point, m_cell)));
        return found == m_faces.end() ? none : found->second;
    }

private:
    double m_cell = 0;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> m_faces;
};

} // namespace

void mark_hanging_faces(const SourceVolume& source, const std::vector<FaceSide>& unpaired, Topology& topology,
                        const TaskControl& control) {
    std::vector<OpenFace> faces;
    faces.reserve(unpaired.size());
    for (const FaceSide side : unpaired) {
        faces.emplace_back(source, topology, side);
    }
    const Grid grid(faces);
    const auto mark = [&](std::uint32_t index) {
        topology.neighbour[unpaired[index] / 8][unpaired[index] % 8] = Topology::unknown_neighbour;
    };
    for (std::uint32_t index = 0; index < faces.size(); ++index) {
        control.check();
        for (const std::uint32_t other : grid.at(faces[index].centre())) {
            if (other != index && faces[other].covers(faces[index].centre(), topology.corners.tolerance)) {
                mark(index);
                mark(other);
            }
        }
    }
}

} // namespace elvis
