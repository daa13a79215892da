// Spaces that hold the functions of two others, and volumes displaced by their fields.

#include "spaces.hpp"

#include <basis/space_change.hpp>
#include <elvis/native/array_volume.hpp>
#include <elvis/native/warped_volume.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

using namespace elvis::native;

namespace {

bool is_small(const Space& space) { return *std::ranges::max_element(space.order) <= 4; }

/** Largest difference between scale times the function and what SpaceChange makes of it. */
double error_of_change(const Space& from, const Space& to, Points& points) {
    const std::vector<double> coefficients = points.coefficients(from);
    std::vector<double> sum(n_modes(to));
    SpaceChange(from, to).add(coefficients, 0.5, sum);
    double largest = 0;
    for (int i = 0; i < 5; ++i) {
        const Point xi = points.xi(from.shape);
        largest = std::max(largest, std::abs(evaluate(to, sum, xi) - 0.5 * evaluate(from, coefficients, xi)));
    }
    return largest;
}

Field field(const char* name, std::uint32_t n_components) {
    Field result;
    result.name = name;
    result.n_components = n_components;
    return result;
}

/** A hexahedron and a tetrahedron, two time steps, with random numbers. */
std::shared_ptr<ArrayVolume> random_volume(Points& points) {
    Description description;
    const auto add_class = [&](Shape shape, Basis basis) {
        const Space linear{shape, basis, {1, 1, 1}}, cubic{shape, Basis::modified, {3, 3, 3}};
        description.classes.push_back({{shape, Basis::modified, {2, 2, 2}}, {cubic, linear, linear}, 2});
    };
    add_class(Shape::hexahedron, Basis::gll_lagrange);
    add_class(Shape::tetrahedron, Basis::orthogonal);
    description.fields = {field("u", 3), field("v", 3), field("p", 1)};
    description.times = {0, 1};
    auto volume = std::make_shared<ArrayVolume>(description, std::vector<Face>());
    const auto fill = [&](std::span<double> numbers) { std::ranges::generate(numbers, [&] { return points.number(); }); };
    for (std::size_t of = 0; of < 2; ++of) {
        fill(volume->geometry(of));
        for (std::size_t index = 0; index < 3; ++index) {
            fill(volume->field(index, 0, of));
            fill(volume->field(index, 1, of));
        }
    }
    return volume;
}

/** A direction of the position, or a component of a field, of a class's second element. */
double value(const Space& space, std::span<const double> numbers, std::size_t n_components, std::size_t component,
             const Point& xi) {
    const std::size_t n = n_modes(space);
    return evaluate(space, numbers.subspan((n_components + component) * n, n), xi);
}

} // namespace

TEST_CASE("The common space of two holds the functions of both") {
    Points points(5);
    double largest = 0;
    std::size_t n_pairs = 0;
    for (const Space& a : test_spaces()) {
        for (const Space& b : test_spaces()) {
            if (a.shape != b.shape || !is_small(a) || !is_small(b)) {
                continue;
            }
            const Space common = common_space(a, b);
            INFO(text(a) << " and " << text(b) << " in " << text(common));
            CHECK_NOTHROW(check(common));
            const double error = std::max(error_of_change(a, common, points), error_of_change(b, common, points));
            CHECK(error < 1e-11);
            largest = std::max(largest, error);
            ++n_pairs;
        }
    }
    std::cout << "largest error in the common spaces of " << n_pairs << " pairs: " << largest << '\n';
}

TEST_CASE("A point of a warped volume is where its complex displacement takes it, and fields go along") {
    Points points(6);
    const std::shared_ptr<ArrayVolume> volume = random_volume(points);
    const Warp warp{0, 1, 1, 0.7, std::numbers::pi / 3};
    const WarpedVolume warped(volume, warp);
    double largest = 0;
    for (std::size_t of = 0; of < 2; ++of) {
        const ElementClass& before = volume->description().classes[of];
        const Space& space = warped.description().classes[of].geometry;
        std::vector<double> geometry(2 * 3 * n_modes(space));
        warped.read_geometry(of, 0, 2, geometry);
        // Blocks are the same as all at once.
        std::vector<double> second(3 * n_modes(space));
        warped.read_geometry(of, 1, 1, second);
        CHECK(std::ranges::equal(second, std::span(geometry).subspan(second.size())));
        for (int i = 0; i < 10; ++i) {
            const Point xi = points.xi(space.shape);
            for (std::size_t d = 0; d < 3; ++d) {
                const double u = value(before.fields[0], volume->field(0, 1, of), 3, d, xi);
                const double v = value(before.fields[1], volume->field(1, 1, of), 3, d, xi);
                const double expected =
                    value(before.geometry, volume->geometry(of), 3, d, xi) + 0.7 * (0.5 * u - std::sqrt(0.75) * v);
                largest = std::max(largest, std::abs(value(space, geometry, 3, d, xi) - expected));
            }
        }
        std::vector<double> p(2 * n_modes(before.fields[2]));
        warped.read_field(2, 1, of, 0, 2, p);
        CHECK(std::ranges::equal(p, volume->field(2, 1, of)));
    }
    std::cout << "largest error of a displaced position: " << largest << '\n';
    CHECK(largest < 1e-13);
}

TEST_CASE("What is no displacement is refused") {
    Points points(7);
    const std::shared_ptr<ArrayVolume> volume = random_volume(points);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const Warp& warp : {Warp{2, {}, 0, 1, 0}, Warp{3, {}, 0, 1, 0}, Warp{0, 2, 0, 1, 0}, Warp{0, {}, 2, 1, 0},
                             Warp{0, {}, 0, nan, 0}, Warp{0, {}, 0, 1, nan}}) {
        CHECK_THROWS_AS(WarpedVolume(volume, warp), std::invalid_argument);
    }
    Description mapped = volume->description();
    mapped.fields[1].transform = Transform::covariant;
    CHECK_THROWS_WITH(WarpedVolume(std::make_shared<ArrayVolume>(mapped, std::vector<Face>()), {}), Catch::Contains("Piola"));
}
