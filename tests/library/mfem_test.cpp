// MFEM's meshes and grid functions as arrays.
#include "mfem_stub/mfem.hpp"

#include <elvis/elvis.hpp>
#include <elvis/mfem.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <random>

namespace {

using mfem::Geometry;
using mfem::Point;

elvis::context without_plugins() {
    auto options = elvis::detail::sized<elvis_context_options>();
    options.plugin_path = "";
    return elvis::context(options);
}

Point bent(const Point& x) { return {x[0] + 0.1 * x[1] * x[2], x[1] - 0.08 * x[0] * x[2], x[2] + 0.05 * x[0] * x[1]}; }

/** Along x: a cube, a cube of two prisms, and, apart from these, a cube of six tetrahedra and one of six pyramids. */
class AllShapes : public mfem::Mesh {
public:
    AllShapes() {
        bdr_attributes = {1, 4};
        const auto cube = [this](double x) {
            const int first = static_cast<int>(vertices.size());
            for (const double z : {0.0, 1.0}) {
                for (const auto& [dx, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
                    vertices.push_back({x + dx, y, z});
                }
            }
            return first;
        };
        const int a = cube(0), b = cube(1), c = cube(3), d = cube(5);
        add(Geometry::CUBE, {a, a + 1, a + 2, a + 3, a + 4, a + 5, a + 6, a + 7});
        // The first cube's vertices at x = 1 are the second's.
        add(Geometry::PRISM, {a + 1, b + 1, b + 2, a + 5, b + 5, b + 6});
        add(Geometry::PRISM, {a + 1, b + 2, a + 2, a + 5, b + 6, a + 6});
        for (const auto& t : {std::array{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}) {
            add(Geometry::TETRAHEDRON, {c + t[0], c + t[1], c + t[2], c + t[3]});
        }
        const int middle = static_cast<int>(vertices.size());
        vertices.push_back({5.5, 0.5, 0.5});
        for (const auto& q : {std::array{0, 1, 2, 3}, {4, 7, 6, 5}, {0, 4, 5, 1}, {3, 2, 6, 7}, {0, 3, 7, 4}, {1, 5, 6, 2}}) {
            add(Geometry::PYRAMID, {d + q[0], d + q[1], d + q[2], d + q[3], middle});
        }
        boundary = {{4, {a, a + 3, a + 7, a + 4}}, {1, {a + 1, b + 2, b + 1}}, {1, {c, c + 1, c + 2}}};
    }

private:
    void add(Geometry::Type geometry, std::vector<int> of) { elements.push_back({geometry, std::move(of)}); }
};

std::vector<double> cubic(const Point& x) { return {x[0] * x[0] * x[1] - x[2] * x[2] * x[2] + 0.3, x[0] * x[1] * x[2] - x[0]}; }

std::vector<double> linear(const Point& x) { return {2 * x[0] - x[1] + 3 * x[2]}; }

} // namespace

TEST_CASE("MFEM's elements of all shapes are the polynomials that they were") {
    AllShapes mesh;
    mesh.bend = bent;
    // Those of the pyramids stay straight, as theirs are not bent.
    mesh.elements.resize(9);
    const mfem::FiniteElementSpace quadratic({2}, mfem::FiniteElementCollection::CONTINUOUS);
    mfem::GridFunction nodes(mesh, quadratic, [](const Point& x) { return std::vector<double>{x[0], x[1], x[2]}; });
    mesh.nodes = &nodes;
    const mfem::FiniteElementSpace mixed({3, 4, 3, 5}, mfem::FiniteElementCollection::CONTINUOUS),
        constant({0}, mfem::FiniteElementCollection::DISCONTINUOUS);
    const mfem::GridFunction u(mesh, mixed, cubic), one(mesh, constant, [](const Point&) { return std::vector<double>{7}; });
    elvis::mfem_arrays volume(mesh);
    volume.add("u", u, "m/s");
    volume.add("one", one);
    CHECK(volume.kinds().size() == 6);
    const elvis::data data = without_plugins().from_arrays(volume.arrays());
    CHECK(data.info().n_elements == 9);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    std::vector<double> points, straight;
    for (int i = 0; i < 300; ++i) {
        const Point x{uniform(random) * 2 + (i % 3 == 0 ? 3 : 0) * 1.0, uniform(random), uniform(random)};
        const Point in = x[0] > 4 ? Point{x[0] - 1, x[1], x[2]} : x;
        const Point at = bent(in);
        points.insert(points.end(), at.begin(), at.end());
        straight.insert(straight.end(), in.begin(), in.end());
    }
    const elvis::probed found = data.probe(points, {"u", "one"});
    double largest = 0;
    for (std::size_t i = 0; i < points.size() / 3; ++i) {
        REQUIRE(found.elements[i] >= 0);
        const std::vector<double> exact = cubic({straight[3 * i], straight[3 * i + 1], straight[3 * i + 2]});
        for (std::size_t component = 0; component < 2; ++component) {
            largest = std::max(largest, std::abs(found.values[3 * i + component] - exact[component]));
        }
        largest = std::max(largest, std::abs(found.values[3 * i + 2] - 7));
    }
    CHECK(largest < 1e-11);
    const auto described = nlohmann::json::parse(data.describe());
    CHECK(described["boundary_groups"] == nlohmann::json{"attribute 1", "attribute 4"});
    CHECK(described["fields"][0]["unit"] == "m/s");
    auto area = elvis::detail::sized<elvis_integration>();
    area.domain = ELVIS_DOMAIN_BOUNDARY;
    const elvis_string left = "attribute 4";
    area.groups = &left;
    area.n_groups = 1;
    area.field = "one";
    CHECK(data.integrate(area).value / data.integrate(area).measure == Approx(7));
    // x = y z / 10 there.
    CHECK(data.integrate(area).measure == Approx(1.0033).margin(2e-4));
    // Halves of squares below prisms and tetrahedra, between 1 and 2 and between 3 and 4, where z = x y / 20.
    const elvis_string below = "attribute 1";
    area.groups = &below;
    area.field = "x";
    CHECK(data.integrate(area).value / data.integrate(area).measure == Approx((5.0 / 3 + 11.0 / 3) / 2).margin(0.02));
    area.field = "z - x*y/20";
    CHECK(data.integrate(area).value == Approx(0).margin(1e-12));
    // No element is turned inside out.
    CHECK(described["negative_jacobians"]["n_positive"] == 9);
}

TEST_CASE("MFEM's straight pyramids are taken with fields of order 1") {
    AllShapes mesh;
    mesh.elements.erase(mesh.elements.begin(), mesh.elements.begin() + 9);
    const mfem::FiniteElementSpace first({1}, mfem::FiniteElementCollection::CONTINUOUS),
        second({2}, mfem::FiniteElementCollection::CONTINUOUS);
    const mfem::GridFunction p(mesh, first, linear), u(mesh, second, cubic);
    elvis::mfem_arrays volume(mesh);
    volume.add("p", p);
    const elvis::data data = without_plugins().from_arrays(volume.arrays());
    const elvis::probed found = data.probe({5.2, 0.3, 0.4, 5.9, 0.7, 0.6}, {"p"});
    CHECK(found.values[0] == Approx(linear({5.2, 0.3, 0.4})[0]).margin(1e-12));
    CHECK(found.values[1] == Approx(linear({5.9, 0.7, 0.6})[0]).margin(1e-12));
    elvis::mfem_arrays refused(mesh);
    refused.add("u", u);
    CHECK_THROWS_WITH(refused.arrays(), Catch::Contains("'u' has order 2"));
}

TEST_CASE("New values of MFEM's fields go to the same arrays, and what is no polynomial is refused") {
    AllShapes mesh;
    mesh.elements.resize(3);
    double factor = 1;
    const mfem::FiniteElementSpace space({3}, mfem::FiniteElementCollection::DISCONTINUOUS),
        curls({1}, mfem::FiniteElementCollection::TANGENTIAL, mfem::FiniteElement::VECTOR, mfem::FiniteElement::H_CURL),
        densities({1}, mfem::FiniteElementCollection::DISCONTINUOUS, mfem::FiniteElement::SCALAR,
                  mfem::FiniteElement::INTEGRAL);
    const mfem::GridFunction u(mesh, space, [&](const Point& x) { return std::vector<double>{factor * x[0]}; });
    elvis::mfem_arrays volume(mesh);
    volume.add("u", u);
    const elvis_arrays& arrays = volume.arrays();
    const double* const before = arrays.fields[0].values[0];
    const double value = before[1];
    factor = 3;
    volume.update();
    CHECK(volume.arrays().fields[0].values[0] == before);
    CHECK(before[1] == Approx(3 * value));
    CHECK_THROWS_WITH(volume.add("late", u), Catch::Contains("before arrays"));
    for (const mfem::FiniteElementSpace* const wrong : {&curls, &densities}) {
        const mfem::GridFunction mapped(mesh, *wrong, cubic);
        elvis::mfem_arrays refused(mesh);
        refused.add("B", mapped);
        CHECK_THROWS_WITH(refused.arrays(), Catch::Contains("'B' is mapped with the geometry"));
    }
    // Another rank has tetrahedra.
    elvis::mfem_arrays with_more(mesh);
    with_more.add("u", u);
    with_more.add_kinds({{Geometry::TETRAHEDRON, {1, 3}}});
    CHECK(with_more.arrays().n_classes == 3);
    CHECK(with_more.arrays().classes[0].n_elements == 0);
    int nothing = 0;
    mesh.NURBSext = &nothing;
    CHECK_THROWS_WITH(elvis::mfem_arrays(mesh), Catch::Contains("NURBS"));
}

TEST_CASE("MFEM's meshes in the plane are surfaces") {
    mfem::Mesh mesh;
    mesh.dimension = 2;
    mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
    mesh.elements = {{Geometry::SQUARE, {0, 1, 4, 3}}, {Geometry::TRIANGLE, {1, 2, 5}}, {Geometry::TRIANGLE, {1, 5, 4}}};
    mesh.boundary = {{2, {3, 0}}, {3, {2, 5}}};
    mesh.bdr_attributes = {2, 3};
    mesh.bend = [](const Point& x) { return Point{x[0], x[1] + 0.1 * x[0] * x[0], 0}; };
    const mfem::FiniteElementSpace quadratic({2}, mfem::FiniteElementCollection::CONTINUOUS),
        space({3}, mfem::FiniteElementCollection::CONTINUOUS);
    mfem::GridFunction nodes(mesh, quadratic, [](const Point& x) { return std::vector<double>{x[0], x[1]}; });
    mesh.nodes = &nodes;
    const mfem::GridFunction u(mesh, space, cubic);
    elvis::mfem_arrays volume(mesh);
    volume.add("u", u);
    const elvis::data data = without_plugins().from_arrays(volume.arrays());
    CHECK(data.info().dimension == 2);
    const elvis::probed found = data.probe({0.4, 0.3 + 0.016, 0, 1.8, 0.5 + 0.324, 0, 1.2, 0.9 + 0.144, 0}, {"u"});
    CHECK(found.elements == std::vector<std::int64_t>{2, 0, 1}); // Triangles first.
    CHECK(found.values[0] == Approx(cubic({0.4, 0.3, 0})[0]).margin(1e-12));
    CHECK(found.values[2] == Approx(cubic({1.8, 0.5, 0})[0]).margin(1e-12));
    CHECK(found.values[4] == Approx(cubic({1.2, 0.9, 0})[0]).margin(1e-12));
}
