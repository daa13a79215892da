#include "boundary.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis::oracle {

namespace {

/** Cells along each side of a face. */
constexpr int n_cells = 24;

/** Corners of the shapes and of their faces as in elvis/element.h. */
Vector reference_corner(native::Shape shape, int k) {
    static const int hexahedron[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                         {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    static const int prism[6][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {-1, 1, 1}};
    static const int tetrahedron[4][3] = {{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    const int* c = shape == native::Shape::hexahedron    ? hexahedron[k]
                   : shape == native::Shape::tetrahedron ? tetrahedron[k]
                                                         : prism[k];
    return {double(c[0]), double(c[1]), double(c[2])};
}

std::string corners_of_face(native::Shape shape, int face) {
    static const std::vector<std::string> hexahedron{"0123", "0154", "1265", "3267", "0374", "4567"};
    static const std::vector<std::string> prism{"0123", "014", "1254", "325", "0354"};
    static const std::vector<std::string> pyramid{"0123", "014", "124", "324", "034"};
    static const std::vector<std::string> tetrahedron{"012", "013", "123", "023"};
    const auto& list = shape == native::Shape::hexahedron ? hexahedron
                       : shape == native::Shape::prism    ? prism
                       : shape == native::Shape::pyramid  ? pyramid
                                                          : tetrahedron;
    return list[static_cast<std::size_t>(face)];
}

double excess(bool is_triangle, double u, double v) {
    return is_triangle ? std::max({-u - 1, -v - 1, u + v}) : std::max(std::abs(u), std::abs(v)) - 1;
}

} // namespace

Boundary::Boundary(const Volume& volume, std::span<const elvis_face> faces) : m_volume(volume) {
    m_lower.setConstant(std::numeric_limits<double>::infinity());
    m_upper = -m_lower;
    for (const elvis_face& given : faces) {
        if (given.neighbour != ELVIS_NEIGHBOUR_NONE)
            continue;
        Face face;
        face.element = static_cast<std::size_t>(given.element);
        const native::Shape shape = volume.shape(face.element);
        const std::string corners = corners_of_face(shape, given.local_face);
        face.is_triangle = corners.size() == 3;
        face.corner = reference_corner(shape, corners[0] - '0');
        face.along_u = 0.5 * (reference_corner(shape, corners[1] - '0') - face.corner);
        face.along_v = 0.5 * (reference_corner(shape, corners.back() - '0') - face.corner);
        face.middle.setZero();
        for (int j = 0; j <= n_cells; ++j)
            for (int i = 0; i <= n_cells; ++i) {
                // Beyond a triangle's edge: the edge.
                const int k = face.is_triangle ? std::min(j, n_cells - i) : j;
                face.samples.push_back(point(face, 2.0 * i / n_cells - 1, 2.0 * k / n_cells - 1, nullptr, nullptr));
                m_lower = m_lower.cwiseMin(face.samples.back());
                m_upper = m_upper.cwiseMax(face.samples.back());
                face.middle += face.samples.back() / ((n_cells + 1) * (n_cells + 1));
            }
        for (const Vector& x : face.samples)
            face.radius = std::max(face.radius, (x - face.middle).norm());
        face.radius *= 1.05;
        m_faces.push_back(std::move(face));
    }
}

Vector Boundary::point(const Face& face, double u, double v, Vector* x_u, Vector* x_v) const {
    const Vector xi = face.corner + (u + 1) * face.along_u + (v + 1) * face.along_v;
    Matrix jacobian;
    const Vector x = m_volume.position(face.element, xi, x_u ? &jacobian : nullptr);
    if (x_u) {
        *x_u = jacobian * face.along_u;
        *x_v = jacobian * face.along_v;
    }
    return x;
}

std::optional<Boundary::Hit> Boundary::hit(const Ray& ray) const {
    const Vector origin = ray.origin.cast<double>(), direction = ray.direction.cast<double>().normalized();
    const Vector across = direction.unitOrthogonal(), up = direction.cross(across);
    std::optional<Hit> nearest;
    for (const Face& face : m_faces) {
        const Vector away = face.middle - origin;
        if ((away - away.dot(direction) * direction).norm() > face.radius)
            continue;
        std::vector<Eigen::Vector2d> seen;
        for (const Vector& x : face.samples)
            seen.emplace_back(across.dot(x - origin), up.dot(x - origin));
        for (int j = 0; j < n_cells; ++j)
            for (int i = 0; i < n_cells; ++i) {
                if (face.is_triangle && i + j > n_cells - 1)
                    continue;
                const int k = j * (n_cells + 1) + i;
                const auto at = [&](int offset) { return seen[static_cast<std::size_t>(k + offset)]; };
                Eigen::Vector2d lower = at(0), upper = at(0);
                for (const int offset : {1, n_cells + 1, n_cells + 2}) {
                    lower = lower.cwiseMin(at(offset));
                    upper = upper.cwiseMax(at(offset));
                }
                // Curved cells bulge by far less than their size.
                const Eigen::Vector2d room = Eigen::Vector2d::Constant(0.3 * (upper - lower).maxCoeff());
                if ((lower - room).maxCoeff() > 0 || (upper + room).minCoeff() < 0)
                    continue;
                double u = (2.0 * i + 1) / n_cells - 1, v = (2.0 * j + 1) / n_cells - 1;
                Vector x, x_u, x_v;
                double step = 1;
                for (int turn = 0; turn < 30 && step > 1e-15; ++turn) {
                    x = point(face, u, v, &x_u, &x_v);
                    Eigen::Matrix2d system;
                    system << across.dot(x_u), across.dot(x_v), up.dot(x_u), up.dot(x_v);
                    const Eigen::Vector2d f(across.dot(x - origin), up.dot(x - origin));
                    const Eigen::Vector2d d = system.fullPivLu().solve(f);
                    step = d.norm();
                    const double cut = step > 4.0 / n_cells ? 4.0 / n_cells / step : 1;
                    u -= cut * d.x();
                    v -= cut * d.y();
                }
                x = point(face, u, v, &x_u, &x_v);
                const Vector normal = x_u.cross(x_v).normalized();
                const double facing = std::abs(normal.dot(direction));
                const double off = (x - origin - (x - origin).dot(direction) * direction).norm();
                const double distance = (x - origin).dot(direction);
                if (excess(face.is_triangle, u, v) > 1e-12 || off > 1e-12 * (1 + origin.norm()) || distance <= 0)
                    continue;
                if (!nearest || distance < nearest->distance)
                    nearest = Hit{distance, facing};
            }
    }
    return nearest;
}

double Boundary::distance(const Vector& position) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Face& face : m_faces) {
        if ((position - face.middle).norm() > 1.1 * face.radius)
            continue;
        const auto nearest =
            std::ranges::min_element(face.samples, {}, [&](const Vector& x) { return (x - position).squaredNorm(); });
        const auto index = static_cast<int>(nearest - face.samples.begin());
        double u = 2.0 * (index % (n_cells + 1)) / n_cells - 1, v = 2.0 * (index / (n_cells + 1)) / n_cells - 1;
        if (face.is_triangle)
            v = std::min(v, -u);
        for (int turn = 0; turn < 20; ++turn) {
            Vector x_u, x_v;
            const Vector x = point(face, u, v, &x_u, &x_v);
            Eigen::Matrix<double, 3, 2> tangents;
            tangents << x_u, x_v;
            const Eigen::Vector2d step = tangents.colPivHouseholderQr().solve(position - x);
            u = std::clamp(u + step.x(), -1.0, 1.0);
            v = std::clamp(v + step.y(), -1.0, face.is_triangle ? -u : 1.0);
        }
        least = std::min(least, (point(face, u, v, nullptr, nullptr) - position).norm());
    }
    return least;
}

Boundary::EdgePoint Boundary::edge_point(std::mt19937& random, bool is_vertex) const {
    const Face& face = m_faces[random() % m_faces.size()];
    const double along = is_vertex ? (random() % 2 ? 1.0 : -1.0) : std::uniform_real_distribution<double>(-1, 1)(random);
    double u = -1, v = -1;
    switch (random() % (face.is_triangle ? 3 : 4)) {
    case 0:
        u = along;
        break;
    case 1:
        v = along;
        break;
    case 2:
        u = face.is_triangle ? -along : 1;
        v = along;
        break;
    default:
        u = along;
        v = 1;
        break;
    }
    EdgePoint result;
    Vector x_u, x_v;
    result.position = point(face, u, v, &x_u, &x_v);
    result.normal = x_u.cross(x_v).normalized();
    return result;
}

} // namespace elvis::oracle
