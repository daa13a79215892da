#include "reference.hpp"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace {

Eigen::Vector3d place(const MshMesh& mesh, const MshElement& element, int node) {
    const auto& x = mesh.nodes.at(element.nodes[static_cast<std::size_t>(node)]);
    return {x[0], x[1], x[2]};
}

} // namespace

Point corner_of(int topology, int corner) {
    // Gmsh's corners in the native numbering. A prism's triangle lies in (xi3, xi1), which keeps the orientation.
    static const int prism[] = {0, 4, 1, 3, 5, 2};
    const int native = topology == 7 ? prism[corner] : corner;
    using elvis::native::Shape;
    static const std::map<int, Shape> shapes{{3, Shape::triangle}, {4, Shape::quadrilateral}, {5, Shape::tetrahedron},
                                             {6, Shape::pyramid},  {7, Shape::prism},         {8, Shape::hexahedron}};
    Point xi = elvis::native::corner(shapes.at(topology), native);
    if (topology <= 4) {
        xi[2] = 0;
    }
    return xi;
}

Point gmsh_point(int topology, const Point& xi) {
    const auto unit = [](double x) { return (1 + x) / 2; };
    switch (topology) {
    case 3:
        return {unit(xi[0]), unit(xi[1]), 0};
    case 5:
        return {unit(xi[0]), unit(xi[1]), unit(xi[2])};
    case 6:
        return {xi[0] + unit(xi[2]), xi[1] + unit(xi[2]), unit(xi[2])};
    case 7:
        return {unit(xi[2]), unit(xi[0]), xi[1]};
    default:
        return xi;
    }
}

namespace {

/** The affine map of a straight element, from corners that span it: the origin and its neighbours. */
struct AffineMap {
    Eigen::Vector3d origin, native_origin;
    /** Columns from the origin to each neighbour, in the world and in native reference coordinates. */
    Eigen::MatrixXd world, native;
};

AffineMap affine_map(const MshMesh& mesh, const MshElement& element) {
    const TypeFacts type = facts(element.type);
    static const std::map<int, std::array<int, 4>> spanning{{3, {0, 1, 2, -1}}, {4, {0, 1, 3, -1}}, {5, {0, 1, 2, 3}},
                                                            {6, {0, 1, 3, 4}},  {7, {0, 1, 2, 3}},  {8, {0, 1, 3, 4}}};
    const auto& corners = spanning.at(type.topology);
    const auto native = [&](int corner) {
        const Point xi = corner_of(type.topology, corner);
        return Eigen::Vector3d(xi[0], xi[1], xi[2]);
    };
    AffineMap map{place(mesh, element, corners[0]), native(corners[0]), Eigen::MatrixXd(3, type.dimension),
                  Eigen::MatrixXd(3, type.dimension)};
    for (int axis = 0; axis < type.dimension; ++axis) {
        const int corner = corners[static_cast<std::size_t>(axis) + 1];
        map.world.col(axis) = place(mesh, element, corner) - map.origin;
        map.native.col(axis) = native(corner) - map.native_origin;
    }
    return map;
}

} // namespace

std::vector<Point> nodes_from_straight(const MshMesh& mesh, const MshElement& element) {
    const TypeFacts type = facts(element.type);
    const AffineMap map = affine_map(mesh, element);
    std::vector<Point> found;
    for (int node = 0; node < type.n_nodes; ++node) {
        const Eigen::VectorXd along = map.world.colPivHouseholderQr().solve(place(mesh, element, node) - map.origin);
        Eigen::Vector3d xi = map.native_origin + map.native * along;
        // Nodes are equispaced; gmsh places those on edges to about 1e-12 only.
        for (int axis = 0; axis < type.dimension; ++axis) {
            const double exact = std::round((xi[axis] + 1) * type.order / 2) * 2 / type.order - 1;
            CHECK(std::abs(xi[axis] - exact) < 1e-9);
            xi[axis] = exact;
        }
        found.push_back({xi[0], xi[1], xi[2]});
    }
    return found;
}

std::vector<std::array<double, 3>> straight_positions(const MshMesh& mesh, const MshElement& element,
                                                      const std::vector<Point>& nodes) {
    const AffineMap map = affine_map(mesh, element);
    std::vector<std::array<double, 3>> positions;
    for (const Point& node : nodes) {
        const Eigen::Vector3d xi(node[0], node[1], node[2]);
        const Eigen::VectorXd along = map.native.colPivHouseholderQr().solve(xi - map.native_origin);
        const Eigen::Vector3d x = map.origin + map.world * along;
        positions.push_back({x[0], x[1], x[2]});
    }
    return positions;
}

std::vector<std::array<int, 3>> monomials(const TypeFacts& type) {
    const int n = type.order;
    std::vector<std::array<int, 3>> found;
    const auto serendipity_triangle = [&](int a, int b) { return a == 0 ? b <= n : b == 0 ? a <= n : a + b == n; };
    for (int a = 0; a <= n; ++a)
        for (int b = 0; b <= n; ++b)
            for (int c = 0; c <= (type.dimension == 3 ? n : 0); ++c) {
                const int larger = std::max(a, b);
                const int n_above_1 = (a > 1) + (b > 1) + (c > 1);
                const int n_zero = (a == 0) + (b == 0) + (c == 0);
                bool is_in = false;
                switch (type.topology) {
                case 3:
                    is_in = type.is_serendipity ? serendipity_triangle(a, b) : a + b <= n;
                    break;
                case 5:
                    is_in = type.is_serendipity ? n_zero >= 2 || (n_zero == 1 && a + b + c == n) : a + b + c <= n;
                    break;
                case 6:
                    is_in = larger + c <= n;
                    if (type.is_serendipity)
                        is_in = is_in && (a + b <= n || (a + b == n + 1 && (a == 1 || b == 1)));
                    break;
                case 7:
                    is_in = type.is_serendipity ? (c <= 1 ? serendipity_triangle(a, b) : a + b <= 1) : a + b <= n;
                    break;
                default:
                    is_in = !type.is_serendipity || n_above_1 <= 1;
                }
                if (is_in)
                    found.push_back({a, b, c});
            }
    return found;
}

double monomial(int topology, const std::array<int, 3>& exponents, const Point& xi) {
    const auto [a, b, c] = exponents;
    const Point u = gmsh_point(topology, xi);
    if (topology == 6) {
        const double rest = 1 - u[2];
        const double top = std::max(a, b) == 0 ? 1 : 0;
        return std::pow(u[2], c) *
               (rest > 1e-14 ? std::pow(u[0] / rest, a) * std::pow(u[1] / rest, b) * std::pow(rest, std::max(a, b)) : top);
    }
    return std::pow(u[0], a) * std::pow(u[1], b) * std::pow(u[2], c);
}

SpaceFunction::SpaceFunction(const TypeFacts& type) : m_topology(type.topology), m_exponents(monomials(type)) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (std::size_t index = 0; index < m_exponents.size(); ++index) {
        m_coefficients.push_back(uniform(random_numbers()) / std::sqrt(static_cast<double>(m_exponents.size())));
    }
}

double SpaceFunction::operator()(const Point& xi) const {
    double sum = 0;
    for (std::size_t index = 0; index < m_exponents.size(); ++index) {
        sum += m_coefficients[index] * monomial(m_topology, m_exponents[index], xi);
    }
    return sum;
}
