// Modes: values against the definitions, counts, order, orthogonality, and which corner, edge and face a mode belongs to.
#include "reference_modes.hpp"
#include "spaces.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace elvis::native;

TEST_CASE("Modes have the values of their definitions in storage order") {
    Points points(1);
    double largest = 0;
    for (const Space& space : test_spaces()) {
        CAPTURE(text(space));
        check(space);
        for (int i = 0; i < 6; ++i) {
            const Point eta = points.eta(space.shape);
            const std::vector<long double> expected = reference_modes(space, eta);
            REQUIRE(n_modes(space) == expected.size());
            std::vector<double> values(n_modes(space));
            evaluate_modes(space, expand(space.shape, eta), values);
            for (std::size_t mode = 0; mode < values.size(); ++mode) {
                const double error = static_cast<double>(std::abs(values[mode] - expected[mode]));
                largest = std::max(largest, error);
                // Orthogonal modes of order 8 reach 100; a hundred roundings of that.
                REQUIRE(error < 1e-12);
            }
        }
    }
    WARN("largest difference " << largest);
}

TEST_CASE("High orders keep their digits") {
    Points points(2);
    for (const Space& space :
         {Space{Shape::hexahedron, Basis::modified, {14, 14, 14}}, Space{Shape::tetrahedron, Basis::modified, {14, 14, 14}},
          Space{Shape::pyramid, Basis::modified, {14, 14, 14}}, Space{Shape::prism, Basis::orthogonal, {14, 14, 14}},
          Space{Shape::pyramid, Basis::orthogonal, {14, 14, 14}}, Space{Shape::quadrilateral, Basis::gll_lagrange, {30, 30, 0}},
          Space{Shape::triangle, Basis::modified, {30, 30, 0}}, Space{Shape::pyramid, Basis::tensor, {14, 14, 14}}}) {
        CAPTURE(text(space));
        double largest = 0;
        double scale = 1;
        for (int i = 0; i < 3; ++i) {
            const Point eta = points.eta(space.shape);
            const std::vector<long double> expected = reference_modes(space, eta);
            std::vector<double> values(n_modes(space));
            evaluate_modes(space, expand(space.shape, eta), values);
            for (std::size_t mode = 0; mode < values.size(); ++mode) {
                largest = std::max(largest, static_cast<double>(std::abs(values[mode] - expected[mode])));
                scale = std::max(scale, std::abs(values[mode]));
            }
        }
        WARN(text(space) << ": largest difference " << largest << ", largest value " << scale);
        CHECK(largest < 1e-11 * scale);
    }
}

TEST_CASE("The largest order works in every shape") {
    Points points(3);
    for (const Space& space :
         {Space{Shape::hexahedron, Basis::gauss_lagrange, {30, 30, 30}},
          Space{Shape::tetrahedron, Basis::modified, {30, 30, 30}}, Space{Shape::pyramid, Basis::modified, {30, 30, 30}},
          Space{Shape::pyramid, Basis::orthogonal, {30, 30, 30}}, Space{Shape::pyramid, Basis::tensor, {30, 30, 30}},
          Space{Shape::prism, Basis::orthogonal, {30, 30, 30}}}) {
        CAPTURE(text(space));
        check(space);
        std::vector<double> values(n_modes(space));
        std::vector<double> gradients(3 * n_modes(space));
        evaluate_modes(space, points.xi(space.shape), values, gradients);
        const auto finite = [](double value) { return std::isfinite(value); };
        CHECK(std::all_of(values.begin(), values.end(), finite));
        CHECK(std::all_of(gradients.begin(), gradients.end(), finite));
    }
}

TEST_CASE("Mode counts follow the formulas") {
    for (std::uint32_t order = 1; order <= max_order; ++order) {
        const std::size_t n = order + 1;
        CHECK(n_modes({Shape::hexahedron, Basis::modified, {order, order, order}}) == n * n * n);
        CHECK(n_modes({Shape::prism, Basis::modified, {order, order, order}}) == n * n * (n + 1) / 2);
        CHECK(n_modes({Shape::pyramid, Basis::modified, {order, order, order}}) == n * (n + 1) * (2 * n + 1) / 6);
        CHECK(n_modes({Shape::pyramid, Basis::tensor, {order, order, order}}) == n * n * n);
        CHECK(n_modes({Shape::tetrahedron, Basis::orthogonal, {order, order, order}}) == n * (n + 1) * (n + 2) / 6);
        CHECK(n_modes({Shape::triangle, Basis::orthogonal, {order, order, 0}}) == n * (n + 1) / 2);
    }
}

TEST_CASE("Orthogonal modes are orthonormal in xi") {
    for (const Space& space :
         {Space{Shape::hexahedron, Basis::orthogonal, {3, 2, 4}}, Space{Shape::prism, Basis::orthogonal, {3, 2, 4}},
          Space{Shape::pyramid, Basis::orthogonal, {4, 4, 4}}, Space{Shape::tetrahedron, Basis::orthogonal, {3, 4, 5}},
          Space{Shape::quadrilateral, Basis::orthogonal, {3, 5, 0}}, Space{Shape::triangle, Basis::orthogonal, {3, 5, 0}}}) {
        CAPTURE(text(space));
        constexpr std::size_t n = 12; // exact to degree 23; the products reach 2 * 8 + 2
        std::vector<double> points(n), weights(n);
        gauss_legendre(points, weights);
        const std::size_t size = n_modes(space);
        std::vector<double> mass(size * size), values(size);
        const bool spatial = dimension(space.shape) == 3;
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                for (std::size_t k = 0; k < (spatial ? n : 1); ++k) {
                    const Point eta{points[i], points[j], spatial ? points[k] : 0.0};
                    const double l2 = (1 - eta[1]) / 2;
                    const double l3 = (1 - eta[2]) / 2;
                    double weight = weights[i] * weights[j] * (spatial ? weights[k] : 1.0);
                    if (space.shape == Shape::prism)
                        weight *= l3;
                    else if (space.shape == Shape::pyramid)
                        weight *= l3 * l3;
                    else if (space.shape == Shape::tetrahedron)
                        weight *= l2 * l3 * l3;
                    else if (space.shape == Shape::triangle)
                        weight *= l2;
                    evaluate_modes(space, expand(space.shape, eta), values);
                    for (std::size_t a = 0; a < size; ++a)
                        for (std::size_t b = 0; b < size; ++b)
                            mass[a * size + b] += weight * values[a] * values[b];
                }
        double largest = 0;
        for (std::size_t a = 0; a < size; ++a)
            for (std::size_t b = 0; b < size; ++b)
                largest = std::max(largest, std::abs(mass[a * size + b] - (a == b ? 1 : 0)));
        CHECK(largest < 1e-12);
    }
}

namespace {

std::size_t find(const Space& space, ModeIndex wanted) {
    const auto indices = reference_indices(space);
    const auto match = [&](const ModeIndex& i) { return i.p == wanted.p && i.q == wanted.q && i.r == wanted.r; };
    const auto position = std::find_if(indices.begin(), indices.end(), match);
    REQUIRE(position != indices.end());
    return static_cast<std::size_t>(position - indices.begin());
}

} // namespace

TEST_CASE("Vertex modes are 1 at their corner and 0 at the others") {
    const std::vector<std::pair<Shape, std::vector<ModeIndex>>> tables{
        {Shape::hexahedron, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}},
        {Shape::prism, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}}},
        {Shape::pyramid, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}},
        {Shape::tetrahedron, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
        {Shape::quadrilateral, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
        {Shape::triangle, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
    for (const auto& [shape, modes] : tables)
        for (const std::uint32_t order : {1U, 4U}) {
            const Space space{shape, Basis::modified, {order, order, dimension(shape) == 3 ? order : 0}};
            CAPTURE(text(space));
            REQUIRE(modes.size() == static_cast<std::size_t>(n_corners(shape)));
            std::vector<std::size_t> positions;
            for (const ModeIndex& mode : modes)
                positions.push_back(find(space, mode));
            std::vector<double> values(n_modes(space));
            for (int i = 0; i < n_corners(shape); ++i) {
                evaluate_modes(space, corner(shape, i), values);
                for (std::size_t mode = 0; mode < values.size(); ++mode)
                    CHECK(values[mode] == (mode == positions[static_cast<std::size_t>(i)] ? 1.0 : 0.0));
            }
            // Together the vertex modes are 1.
            Points points(4);
            for (int i = 0; i < 10; ++i) {
                evaluate_modes(space, points.xi(shape), values);
                double sum = 0;
                for (const std::size_t position : positions)
                    sum += values[position];
                CHECK(sum == Approx(1).epsilon(1e-14));
            }
        }
}

TEST_CASE("At order 1 coefficients are corner values in the order that format.md lists") {
    const std::vector<std::pair<Shape, std::vector<int>>> orders{{Shape::hexahedron, {0, 1, 3, 2, 4, 5, 7, 6}},
                                                                 {Shape::prism, {0, 4, 3, 5, 1, 2}},
                                                                 {Shape::pyramid, {0, 4, 3, 1, 2}},
                                                                 {Shape::tetrahedron, {0, 3, 2, 1}},
                                                                 {Shape::quadrilateral, {0, 1, 3, 2}},
                                                                 {Shape::triangle, {0, 2, 1}}};
    for (const auto& [shape, corners] : orders) {
        const Space space{shape, Basis::modified, {1, 1, dimension(shape) == 3 ? 1U : 0U}};
        CAPTURE(text(space));
        std::vector<double> values(n_modes(space));
        REQUIRE(values.size() == corners.size());
        for (std::size_t mode = 0; mode < values.size(); ++mode) {
            evaluate_modes(space, corner(shape, corners[mode]), values);
            CHECK(values[mode] == 1.0);
        }
    }
}

TEST_CASE("Edge and face modes vanish on the faces that do not hold them") {
    struct Entity {
        Shape shape;
        ModeIndex mode;
        std::vector<int> corners; // of the edge or face; empty: interior
    };
    const int m = 3;
    const std::vector<Entity> entities{{Shape::prism, {m, 0, 0}, {0, 1}},
                                       {Shape::prism, {1, m, 0}, {1, 2}},
                                       {Shape::prism, {0, 0, m}, {0, 4}},
                                       {Shape::prism, {1, 0, m - 1}, {1, 4}},
                                       {Shape::prism, {1, 1, m - 1}, {2, 5}},
                                       {Shape::prism, {0, m, 1}, {4, 5}},
                                       {Shape::prism, {2, 2, 0}, {0, 1, 2, 3}},
                                       {Shape::prism, {2, 1, 1}, {3, 2, 5}},
                                       {Shape::prism, {1, 2, 1}, {1, 2, 5, 4}},
                                       {Shape::pyramid, {0, 0, m}, {0, 4}},
                                       {Shape::pyramid, {1, 0, m - 1}, {1, 4}},
                                       {Shape::pyramid, {1, 1, m - 1}, {2, 4}},
                                       {Shape::pyramid, {0, 1, m - 1}, {3, 4}},
                                       {Shape::pyramid, {2, 3, 0}, {0, 1, 2, 3}},
                                       {Shape::pyramid, {2, 0, 1}, {0, 1, 4}},
                                       {Shape::pyramid, {1, 2, 1}, {1, 2, 4}},
                                       {Shape::pyramid, {2, 2, 1}, {}},
                                       {Shape::tetrahedron, {m, 0, 0}, {0, 1}},
                                       {Shape::tetrahedron, {1, m - 1, 0}, {1, 2}},
                                       {Shape::tetrahedron, {0, m, 0}, {0, 2}},
                                       {Shape::tetrahedron, {0, 0, m}, {0, 3}},
                                       {Shape::tetrahedron, {1, 0, m - 1}, {1, 3}},
                                       {Shape::tetrahedron, {0, 1, m - 1}, {2, 3}},
                                       {Shape::tetrahedron, {2, 1, 0}, {0, 1, 2}},
                                       {Shape::tetrahedron, {2, 0, 1}, {0, 1, 3}},
                                       {Shape::tetrahedron, {1, 1, 1}, {1, 2, 3}},
                                       {Shape::tetrahedron, {0, 2, 1}, {0, 2, 3}},
                                       {Shape::tetrahedron, {2, 1, 1}, {}}};
    Points points(5);
    for (const Entity& entity : entities) {
        const Space space{entity.shape, Basis::modified, {4, 4, 4}};
        CAPTURE(text(space), entity.mode.p, entity.mode.q, entity.mode.r);
        const std::size_t mode = find(space, entity.mode);
        std::vector<double> values(n_modes(space));
        for (int face = 0; face < n_faces(entity.shape); ++face) {
            const auto corners = face_corners(entity.shape, face);
            const bool holds = !entity.corners.empty() && std::all_of(entity.corners.begin(), entity.corners.end(), [&](int c) {
                return std::find(corners.begin(), corners.end(), c) != corners.end();
            });
            double largest = 0;
            for (int i = 0; i < 20; ++i) {
                // A random convex combination of the corners of the face lies on it.
                Point xi{};
                double total = 0;
                for (const int c : corners) {
                    const double weight = 1 + points.number();
                    total += weight;
                    for (std::size_t d = 0; d < 3; ++d)
                        xi[d] += weight * corner(entity.shape, c)[d];
                }
                for (double& x : xi)
                    x /= total;
                evaluate_modes(space, xi, values);
                largest = std::max(largest, std::abs(values[mode]));
            }
            if (holds)
                CHECK(largest > 1e-3);
            else
                CHECK(largest < 1e-14);
        }
    }
}

TEST_CASE("check refuses spaces that do not exist") {
    const std::vector<Space> wrong{
        {Shape::tetrahedron, Basis::gll_lagrange, {2, 2, 2}}, {Shape::hexahedron, Basis::tensor, {2, 2, 2}},
        {Shape::hexahedron, Basis::modified, {31, 2, 2}},     {Shape::hexahedron, Basis::modified, {2, 0, 2}},
        {Shape::quadrilateral, Basis::modified, {2, 2, 1}},   {Shape::pyramid, Basis::modified, {2, 2, 3}},
        {Shape::pyramid, Basis::orthogonal, {3, 2, 3}},       {Shape::tetrahedron, Basis::modified, {3, 2, 3}},
        {Shape::prism, Basis::modified, {3, 2, 2}},           {Shape::triangle, Basis::modified, {3, 2, 0}},
        {static_cast<Shape>(6), Basis::modified, {2, 2, 2}},  {Shape::hexahedron, static_cast<Basis>(5), {2, 2, 2}}};
    for (const Space& space : wrong) {
        CAPTURE(text(space));
        CHECK_THROWS_AS(check(space), std::invalid_argument);
    }
    for (const Space& space : test_spaces())
        CHECK_NOTHROW(check(space));
}
