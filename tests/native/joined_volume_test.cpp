// Volumes with the fields of others beside their own.

#include "spaces.hpp"

#include <basis/space_change.hpp>
#include <elvis/native/array_volume.hpp>
#include <elvis/native/joined_volume.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

using namespace elvis::native;

namespace {

constexpr std::uint64_t n_elements = 2;

Field named_field(const char* name, std::uint32_t n_components = 1) {
    Field result;
    result.name = name;
    result.n_components = n_components;
    return result;
}

struct Kind {
    std::uint32_t order = 1, geometry_order = 1;
    std::size_t n_steps = 1;
    Basis basis = Basis::modified;
    std::vector<Shape> shapes{Shape::hexahedron, Shape::prism};
};

/** The same linear elements, written in any order; fields p and u with random numbers. */
std::shared_ptr<ArrayVolume> some_volume(Points& points, const Kind& kind) {
    Description description;
    const auto cube = [](std::uint32_t n) { return std::array<std::uint32_t, 3>{n, n, n}; };
    for (const Shape shape : kind.shapes) {
        const Space space{shape, kind.basis, cube(kind.order)};
        description.classes.push_back({{shape, kind.basis, cube(kind.geometry_order)}, {space, space}, n_elements});
    }
    description.fields = {named_field("p"), named_field("u", 3)};
    description.times.assign(kind.n_steps, 0.0);
    auto volume = std::make_shared<ArrayVolume>(description, std::vector<Face>());
    Points mesh(11);
    for (std::size_t of = 0; of < kind.shapes.size(); ++of) {
        const Space linear{kind.shapes[of], Basis::orthogonal, {1, 1, 1}};
        const Space& space = description.classes[of].geometry;
        const SpaceChange change(linear, space);
        std::ranges::fill(volume->geometry(of), 0.0);
        for (std::size_t row = 0; row < 3 * n_elements; ++row)
            change.add(mesh.coefficients(linear), 1, volume->geometry(of).subspan(row * n_modes(space), n_modes(space)));
        for (std::size_t index = 0; index < 2; ++index)
            for (std::size_t step = 0; step < kind.n_steps; ++step)
                std::ranges::generate(volume->field(index, step, of), [&] { return points.number(); });
    }
    return volume;
}

/** A component of a field in a class's second element. */
double value(const VolumeSource& source, std::size_t field, std::size_t step, std::size_t of, std::size_t component,
             const Point& xi) {
    const Space& space = source.description().classes[of].fields[field];
    const std::size_t n = n_modes(space), n_components = source.description().fields[field].n_components;
    std::vector<double> numbers(n_components * n);
    source.read_field(field, step, of, 1, 1, numbers);
    return evaluate(space, std::span(numbers).subspan(component * n, n), xi);
}

std::string refusal(const std::shared_ptr<ArrayVolume>& volume, std::vector<Joined> others) {
    try {
        const JoinedVolume joined(volume, std::move(others));
    } catch (const std::invalid_argument& reason) {
        return reason.what();
    }
    return "accepted";
}

} // namespace

TEST_CASE("A joined volume has its own fields, those of the other, and their differences") {
    Points points(8);
    const auto volume = some_volume(points, {3, 1, 2, Basis::modified});
    const auto other = some_volume(points, {5, 2, 3, Basis::orthogonal});
    // Each step of the volume beside the other's step 2; and beside the volume's own step 0.
    const JoinedVolume joined(volume, {{"b", other, 2}, {"first", volume, 0}});
    std::vector<std::string> names;
    for (const Field& field : joined.description().fields)
        names.push_back(field.name);
    REQUIRE(names == std::vector<std::string>{"p", "u", "b.p", "b.u", "first.p", "first.u", "p - b.p", "u - b.u", "p - first.p",
                                              "u - first.u"});
    double largest = 0;
    for (std::size_t of = 0; of < 2; ++of) {
        for (int i = 0; i < 20; ++i) {
            const Point xi = points.xi(joined.description().classes[of].geometry.shape);
            const double p = value(*volume, 0, 1, of, 0, xi), u = value(*volume, 1, 1, of, 2, xi);
            const double b_p = value(*other, 0, 2, of, 0, xi), b_u = value(*other, 1, 2, of, 2, xi);
            CHECK(value(joined, 0, 1, of, 0, xi) == p);
            CHECK(value(joined, 3, 1, of, 2, xi) == b_u);
            CHECK(value(joined, 4, 1, of, 0, xi) == value(*volume, 0, 0, of, 0, xi));
            largest = std::max({largest, std::abs(value(joined, 6, 1, of, 0, xi) - (p - b_p)),
                                std::abs(value(joined, 7, 1, of, 2, xi) - (u - b_u)),
                                std::abs(value(joined, 8, 1, of, 0, xi) - (p - value(*volume, 0, 0, of, 0, xi)))});
        }
    }
    std::cout << "largest error of a difference: " << largest << '\n';
    CHECK(largest < 1e-12);
}

TEST_CASE("The other volume's time step is the same one, or the only one") {
    Points points(9);
    const auto volume = some_volume(points, {2, 1, 2}), one = some_volume(points, {2, 1, 1}),
               two = some_volume(points, {2, 1, 2});
    const JoinedVolume joined(volume, {{"one", one, {}}, {"two", two, {}}});
    const Point xi{0.1, -0.3, 0.2};
    CHECK(value(joined, 2, 1, 0, 0, xi) == value(*one, 0, 0, 0, 0, xi));
    CHECK(value(joined, 4, 1, 0, 0, xi) == value(*two, 0, 1, 0, 0, xi));
}

TEST_CASE("What cannot be joined is refused, with the reason") {
    Points points(10);
    const auto volume = some_volume(points, {2, 1, 2});
    CHECK_THAT(refusal(volume, {{"a b", volume, 0}}), Catch::Contains("'a b' is no name"));
    CHECK_THAT(refusal(volume, {{"2", volume, 0}}), Catch::Contains("is no name"));
    CHECK_THAT(refusal(volume, {{"b", volume, 0}, {"b", volume, 1}}), Catch::Contains("'b' is joined twice"));
    CHECK_THAT(refusal(volume, {{"b", volume, 2}}), Catch::Contains("has 2 time steps, no time step 2"));
    CHECK_THAT(refusal(volume, {{"b", some_volume(points, {2, 1, 3}), {}}}), Catch::Contains("has 3 time steps, not 2"));
    CHECK_THAT(refusal(volume, {{"b", some_volume(points, {2, 1, 1, Basis::modified, {Shape::hexahedron}}), {}}}),
               Catch::Contains("2 elements, not 4"));
    const auto turned = some_volume(points, {2, 1, 1, Basis::modified, {Shape::prism, Shape::hexahedron}});
    CHECK_THAT(refusal(volume, {{"b", turned, {}}}), Catch::Contains("other classes"));
    const auto moved = some_volume(points, {2, 1, 1});
    // The second element of the second class.
    moved->geometry(1).back() += 1e-8;
    CHECK_THAT(refusal(volume, {{"b", moved, {}}}), Catch::Contains("element 3 is not where it is here"));
    moved->geometry(1).back() -= 1e-8;
    CHECK(refusal(volume, {{"b", moved, {}}}) == "accepted");
}
