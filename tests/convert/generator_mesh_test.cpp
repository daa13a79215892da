// Generated meshes close: faces meet in pairs with the same map, all else is boundary, and no element is inside out.
#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <elvis/native/space.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>

namespace {

using namespace elvis;
using std::numbers::pi;

struct Case {
    std::string mesh;
    std::string keys;
    double volume;
    /** Relative error of the volume that the geometry order leaves. */
    double tolerance;
};

// Half edges of the cores and numbers of cells small enough to be quick, uneven enough to mix up nothing.
const std::vector<Case> cases{
    {"box", R"("box":[[-1,0,2],[2,1,4]],"elements":[4,2,3])", 6, 1e-9},
    {"waves", R"("elements":[4,3,2],"geometry_order":2)", 8, 0.02},
    {"ball", R"("elements":[2,3,1],"layers":2,"geometry_order":3)", 4.0 / 3 * pi, 5e-3},
    {"hemisphere", R"("elements":[3,2,1],"layers":2,"radius":2,"geometry_order":3)", 16.0 / 3 * pi, 5e-3},
    {"shell", R"("elements":[2,3,1],"layers":2,"inner_radius":0.6,"geometry_order":3)", 4.0 / 3 * pi*(1 - 0.216), 5e-3},
    {"torus", R"("elements":[2,1,5],"layers":2,"geometry_order":3)", 2 * pi* pi * 0.16, 5e-3}};

const std::vector<std::string> shapes{"hexahedron", "prism", "tetrahedron", "pyramid", "mixed"};

std::string describe(const Case& c, const std::string& shape) {
    return R"({"generator":1,"mesh":")" + c.mesh + R"(","shape":")" + shape + R"(",)" + c.keys + R"(,"field":"sphere"})";
}

std::vector<elvis_source_element> all_elements(const SourceVolume& source) {
    std::vector<elvis_source_element> elements(source.info().n_elements);
    source.elements(0, elements.size(), elements);
    return elements;
}

// Quadrature of a reference shape, exact for the Jacobians of mappings up to `order`, with points for differences around.
struct Quadrature {
    static constexpr double h = 1e-5;
    std::vector<double> weights;
    /** Six points for each weight: xi - h e_d and xi + h e_d for d = 0, 1, 2. */
    std::vector<double> points;

    Quadrature(native::Shape shape, std::size_t order) {
        // det J is of degree 3g - 1 in each direction, and up to 2 more with the collapse: exact for 2n - 1 >= 3g + 1.
        const std::size_t n = 3 * order / 2 + 2;
        std::vector<double> z(n);
        std::vector<double> w(n);
        native::gauss_legendre(z, w);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j)
                for (std::size_t k = 0; k < n; ++k) {
                    const double l2 = 0.5 * (1 - z[j]);
                    const double l3 = 0.5 * (1 - z[k]);
                    const double collapse = shape == native::Shape::prism         ? l3
                                            : shape == native::Shape::pyramid     ? l3 * l3
                                            : shape == native::Shape::tetrahedron ? l2 * l3 * l3
                                                                                  : 1;
                    weights.push_back(w[i] * w[j] * w[k] * collapse);
                    for (std::size_t d = 0; d < 3; ++d)
                        for (double step : {-h, h}) {
                            native::Point xi = native::expand(shape, {z[i], z[j], z[k]});
                            xi[d] += step;
                            points.insert(points.end(), xi.begin(), xi.end());
                        }
                }
    }
};

// Volume and smallest Jacobian of an element. Central differences of a smooth mapping: h^2 and rounding / h are below 1e-9.
struct Size {
    double volume = 0;
    double smallest = std::numeric_limits<double>::infinity();
};

Size measure(const SourceVolume& source, std::uint64_t element, const Quadrature& quadrature) {
    std::vector<double> x(quadrature.points.size());
    source.evaluate_mapping(element, quadrature.points, x);
    Size size;
    for (std::size_t point = 0; point < quadrature.weights.size(); ++point) {
        std::array<std::array<double, 3>, 3> a;
        for (std::size_t d = 0; d < 3; ++d)
            for (std::size_t e = 0; e < 3; ++e)
                a[d][e] = (x[18 * point + 6 * d + 3 + e] - x[18 * point + 6 * d + e]) / (2 * Quadrature::h);
        const double j = a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
                         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
        size.volume += quadrature.weights[point] * j;
        size.smallest = std::min(size.smallest, j);
    }
    return size;
}

Size measure_all(const SourceVolume& source, const std::vector<elvis_source_element>& elements) {
    std::map<elvis_shape, Quadrature> quadratures;
    Size total;
    for (std::uint64_t e = 0; e < elements.size(); ++e) {
        const auto& [shape, rule] =
            *quadratures
                 .try_emplace(elements[e].shape, static_cast<native::Shape>(elements[e].shape), elements[e].geometry_order[0])
                 .first;
        const Size size = measure(source, e, rule);
        total.volume += size.volume;
        total.smallest = std::min(total.smallest, size.smallest);
    }
    return total;
}

struct Side {
    std::uint64_t element;
    int face;
    /** Corner ids in the order of the face. */
    std::vector<std::int64_t> ids;
    std::int32_t group;
};

std::map<std::vector<std::int64_t>, std::vector<Side>> sides_by_corners(const std::vector<elvis_source_element>& elements) {
    std::map<std::vector<std::int64_t>, std::vector<Side>> faces;
    for (std::uint64_t e = 0; e < elements.size(); ++e) {
        const auto shape = static_cast<native::Shape>(elements[e].shape);
        for (int face = 0; face < native::n_faces(shape); ++face) {
            Side side{e, face, {}, elements[e].face_groups[face]};
            for (int corner : native::face_corners(shape, face))
                side.ids.push_back(elements[e].corners[corner]);
            std::vector<std::int64_t> key = side.ids;
            std::ranges::sort(key);
            faces[key].push_back(side);
        }
    }
    return faces;
}

// Positions at points of a face given by weights of its corners, in the order of `ids`.
std::vector<double> positions(const SourceVolume& source, elvis_shape shape, const Side& side,
                              const std::vector<std::int64_t>& ids) {
    const auto reference = static_cast<native::Shape>(shape);
    std::vector<double> xi;
    for (const auto& [u, v] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.2, 0.0}, {0.3, 0.4}, {0.55, 0.1}, {0.05, 0.7}, {0.0, 0.6}}) {
        const std::vector<double> weights = ids.size() == 3
                                                ? std::vector<double>{1 - u - v, u, v}
                                                : std::vector<double>{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
        native::Point point{};
        for (std::size_t i = 0; i < ids.size(); ++i) {
            const auto place = std::ranges::find(side.ids, ids[i]) - side.ids.begin();
            const native::Point corner =
                native::corner(reference, native::face_corners(reference, side.face)[static_cast<std::size_t>(place)]);
            for (std::size_t d = 0; d < 3; ++d)
                point[d] += weights[i] * corner[d];
        }
        xi.insert(xi.end(), point.begin(), point.end());
    }
    std::vector<double> x(xi.size());
    source.evaluate_mapping(side.element, xi, x);
    return x;
}

} // namespace

TEST_CASE("every mesh of every shape is closed, conforming and right side out", "[generator]") {
    double largest_gap = 0;
    for (const Case& c : cases)
        for (const std::string& shape : shapes) {
            CAPTURE(c.mesh, shape);
            const SourceVolume source = generate(describe(c, shape));
            const std::vector<elvis_source_element> elements = all_elements(source);

            std::map<elvis_shape, int> counts;
            for (const elvis_source_element& element : elements)
                ++counts[element.shape];
            const Size size = measure_all(source, elements);
            CHECK(size.smallest > 0);
            CHECK(size.volume == Approx(c.volume).epsilon(c.tolerance));
            CHECK(counts.size() == (shape == "mixed" ? 4u : 1u));

            for (const auto& [key, sides] : sides_by_corners(elements)) {
                REQUIRE(sides.size() <= 2);
                if (sides.size() == 1) {
                    CHECK(sides[0].group >= 0);
                    continue;
                }
                CHECK(sides[0].group == ELVIS_GROUP_NONE);
                CHECK(sides[1].group == ELVIS_GROUP_NONE);
                if (key.size() == 3)
                    CHECK(sides[0].ids.back() == sides[1].ids.back());
                const std::vector<double> a = positions(source, elements[sides[0].element].shape, sides[0], sides[0].ids);
                const std::vector<double> b = positions(source, elements[sides[1].element].shape, sides[1], sides[0].ids);
                for (std::size_t i = 0; i < a.size(); ++i)
                    largest_gap = std::max(largest_gap, std::abs(a[i] - b[i]));
            }
        }
    std::printf("generator: largest gap between neighbours %.2g\n", largest_gap);
    CHECK(largest_gap < 1e-13);
}

TEST_CASE("volumes of round meshes converge with the geometry order", "[generator]") {
    for (const std::string& shape : shapes) {
        std::vector<double> errors;
        for (int order : {1, 2, 3, 4, 6}) {
            const SourceVolume source =
                generate(R"({"generator":1,"mesh":"ball","shape":")" + shape +
                         R"(","elements":1,"layers":2,"geometry_order":)" + std::to_string(order) + R"(,"field":"sphere"})");
            const Size size = measure_all(source, all_elements(source));
            errors.push_back(std::abs(size.volume / (4.0 / 3 * pi) - 1));
        }
        std::printf("ball of %s: relative error of the volume %.1e %.1e %.1e %.1e %.1e at geometry orders 1 2 3 4 6\n",
                    shape.c_str(), errors[0], errors[1], errors[2], errors[3], errors[4]);
        CHECK(errors[1] < 0.2 * errors[0]);
        CHECK(errors[2] < 0.1 * errors[1]);
        CHECK(errors[4] < 0.01 * errors[1]);
    }
}

TEST_CASE("the twisted tetrahedron is the one that was asked for", "[generator]") {
    const SourceVolume source = generate(R"({"generator":1,"mesh":"twisted-tetrahedron","field":"sphere"})");
    REQUIRE(source.info().n_elements == 1);
    const std::array<double, 15> xi{-1, -1, -1, 1, -1, -1, -1, -1, 1, 0, -1, -1, -1, 0, -1};
    std::array<double, 15> x;
    source.evaluate_mapping(0, xi, x);
    const std::array<double, 15> expected{0, 0, 0, 1, 0, 0, 0, 0, 1, 0.5, 0, 0.6, 0, 0.5, 0};
    for (std::size_t i = 0; i < x.size(); ++i)
        CHECK(x[i] == Approx(expected[i]).margin(1e-15));
    CHECK(measure_all(source, all_elements(source)).smallest < 0);
}

TEST_CASE("millions of elements cost nothing until they are asked for", "[generator]") {
    const SourceVolume source =
        generate(R"({"generator":1,"mesh":"torus","shape":"tetrahedron","elements":[64,64,512],"layers":16,"field":"waves"})");
    CHECK(source.info().n_elements == 6ull * (64 * 64 + 4 * 64 * 16) * 512);
    std::vector<elvis_source_element> last(1);
    source.elements(source.info().n_elements - 1, 1, last);
    for (int corner = 0; corner < 4; ++corner)
        CHECK(static_cast<std::uint64_t>(last[0].corners[corner]) < source.info().n_corner_ids);
}
