// The program's inverse mapping on the CPU, on elements made from formulas.
#include <core/oracle/picture/picture.hpp>
#include <core/oracle/samples/exact_volumes.hpp>

#include <core/probe/newton.hpp>
#include <core/probe/reference_shape.hpp>
#include <tests/support/test_volumes.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>
#include <random>
#include <utility>

namespace elvis::oracle {
namespace {

using native::Shape;

MappingFunction mapping_of(const Volume& volume, std::size_t element = 0) {
    return [&volume, element](std::span<const double> xi, std::span<double> positions, std::span<double> jacobians) {
        for (std::size_t i = 0; i + 2 < xi.size(); i += 3) {
            Matrix jacobian;
            const Vector x = volume.position(element, {xi[i], xi[i + 1], xi[i + 2]}, &jacobian);
            for (Eigen::Index d = 0; d < 3; ++d)
                positions[i + static_cast<std::size_t>(d)] = x[d];
            for (std::size_t entry = 0; entry < 9 && !jacobians.empty(); ++entry)
                jacobians[3 * i + entry] = jacobian(static_cast<Eigen::Index>(entry / 3), static_cast<Eigen::Index>(entry % 3));
        }
    };
}

// A quarter of a thick bent tube: strongly curved, with a regular Jacobian.
Vector tube(const Vector& xi) {
    const double angle = 0.75 * (xi.x() + 1);
    const double radius = 1.3 + xi.y();
    return {radius * std::cos(angle), radius * std::sin(angle), 0.5 * xi.z() + 0.1 * xi.x() * xi.y()};
}

Model one_element(Shape shape, std::uint32_t order, const Map& map) {
    VolumeData data;
    data.classes.push_back(make_class(space_of(shape, order), space_of(shape, 1), {map}, [](const Vector&) { return 0.0; }));
    return Model(std::move(data));
}

} // namespace

TEST_CASE("points are projected into the reference shape") {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-3.0, 3.0);
    for (elvis_shape shape = ELVIS_SHAPE_HEXAHEDRON; shape <= ELVIS_SHAPE_TETRAHEDRON; ++shape) {
        for (int i = 0; i < 2000; ++i) {
            const std::array<double, 3> xi{uniform(random), uniform(random), uniform(random)};
            const double distance = reference_excess(shape, xi);
            REQUIRE(distance == Approx(excess(static_cast<Shape>(shape), {xi[0], xi[1], xi[2]})).margin(1e-15));
            const std::array<double, 3> projected = project_into_shape(shape, xi);
            REQUIRE(reference_excess(shape, projected) <= 1e-15);
            if (distance <= 0)
                REQUIRE(projected == xi);
        }
        CHECK(reference_excess(shape, reference_centroid(shape)) < -0.2);
    }
}

TEST_CASE("the inverse mapping finds every point of strongly curved elements") {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (const Shape shape : {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron}) {
        const Model model = one_element(shape, 6, tube);
        const MappingFunction mapping = mapping_of(model.volume);
        double largest_error = 0;
        for (int i = 0; i < 400; ++i) {
            Vector xi(uniform(random), uniform(random), uniform(random));
            if (i % 4 == 0)
                xi[i / 4 % 3] = -1;
            if (excess(shape, xi) > 0)
                continue;
            const Vector x = model.volume.position(0, xi);
            const Inversion inversion = invert_mapping(static_cast<elvis_shape>(shape), mapping, {x[0], x[1], x[2]});
            CAPTURE(native::name(shape), xi.transpose());
            REQUIRE(inversion.outcome == Inversion::Outcome::inside);
            largest_error = std::max(
                largest_error, (Vector(inversion.xi[0], inversion.xi[1], inversion.xi[2]) - xi).lpNorm<Eigen::Infinity>());
        }
        CAPTURE(native::name(shape), largest_error);
        CHECK(largest_error < 1e-13);
    }
}

TEST_CASE("many points of a strongly curved element are where each of them is alone, in fewer evaluations") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-1.2, 1.2);
    for (const Shape shape : {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron}) {
        const Model model = one_element(shape, 6, tube);
        const MappingFunction mapping = mapping_of(model.volume);
        std::size_t n_evaluations = 0;
        const MappingFunction counted = [&](std::span<const double> xi, std::span<double> positions,
                                            std::span<double> jacobians) {
            n_evaluations += xi.size() / 3;
            mapping(xi, positions, jacobians);
        };
        std::vector<Vector3> targets, inside;
        for (int i = 0; i < 1000; ++i) {
            const Vector xi{uniform(random), uniform(random), uniform(random)}, x = tube(xi);
            targets.push_back({x[0], x[1], x[2]});
            if (excess(shape, xi) < 0)
                inside.push_back(targets.back());
        }
        invert_mapping(static_cast<elvis_shape>(shape), counted, inside);
        const double a_point = static_cast<double>(std::exchange(n_evaluations, 0)) / static_cast<double>(inside.size());
        const std::vector<Inversion> together = invert_mapping(static_cast<elvis_shape>(shape), counted, targets);
        const std::size_t n_together = std::exchange(n_evaluations, 0);
        double largest_difference = 0;
        for (std::size_t i = 0; i < targets.size(); ++i) {
            const Inversion alone = invert_mapping(static_cast<elvis_shape>(shape), counted, targets[i]);
            CAPTURE(native::name(shape), targets[i]);
            REQUIRE(alone.outcome == together[i].outcome);
            for (std::size_t d = 0; d < 3 && alone.outcome == Inversion::Outcome::inside; ++d)
                largest_difference = std::max(largest_difference, std::abs(alone.xi[d] - together[i].xi[d]));
        }
        CHECK(largest_difference < 1e-13);
        // 3.6 to 4.2; from the centroid 5 and more.
        CHECK(a_point < 4.5);
        // 15 to 30 a point; where searches outside go on until they settle 40 to 105.
        CHECK(n_together < 35 * targets.size());
        std::cout << native::name(shape) << ": inside " << a_point << " evaluations a point; around it " << n_together
                  << " evaluations, alone " << n_evaluations << ", differences at most " << largest_difference << '\n';
    }
}

TEST_CASE("the inverse mapping finds points of pyramids whose Jacobian nearly vanishes") {
    // A ring of four elements' length, cut into pyramids.
    const TemporaryFile file("torus.h5");
    generate(R"({"generator": 1, "mesh": "torus", "shape": "pyramid", "elements": [3, 1, 4], "layers": 2,)"
             R"( "order": 1, "geometry_order": 4, "field": "sinc"})",
             file.path());
    const Volume volume(read_volume(file.path()));
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    std::size_t n_points = 0, n_lost = 0;
    for (std::size_t element = 0; element < volume.n_elements(); element += 7) {
        const MappingFunction mapping = mapping_of(volume, element);
        for (int i = 0; i < 100; ++i) {
            const Vector xi(uniform(random), uniform(random), uniform(random));
            if (excess(Shape::pyramid, xi) > 0)
                continue;
            const Vector x = volume.position(element, xi);
            ++n_points;
            n_lost += invert_mapping(ELVIS_SHAPE_PYRAMID, mapping, {x[0], x[1], x[2]}).outcome != Inversion::Outcome::inside;
        }
    }
    std::cout << "pyramids of a torus: " << n_lost << " of " << n_points << " points lost\n";
    CHECK(n_lost == 0);
}

TEST_CASE("the inverse mapping agrees with the oracle about points around an element") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (const Shape shape : {Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron}) {
        const Model model = one_element(shape, 6, tube);
        const MappingFunction mapping = mapping_of(model.volume);
        Inverter inverter(model.volume, model.enclosures);
        std::size_t n_inside = 0;
        for (int i = 0; i < 400; ++i) {
            const Vector fraction(uniform(random), uniform(random), uniform(random));
            const Vector x = model.tree.lower() + fraction.cwiseProduct(model.tree.upper() - model.tree.lower());
            const bool is_inside = !inverter.find(0, x, inside_tolerance).empty();
            n_inside += is_inside;
            const Inversion inversion = invert_mapping(static_cast<elvis_shape>(shape), mapping, {x[0], x[1], x[2]});
            CAPTURE(native::name(shape), x.transpose());
            REQUIRE(inversion.outcome == (is_inside ? Inversion::Outcome::inside : Inversion::Outcome::outside));
        }
        CHECK(n_inside > 10);
    }
}

TEST_CASE("the inverse mapping ends on an element with negative Jacobians") {
    const Model model = one_element(Shape::tetrahedron, 2, twisted_tetrahedron({0, 0, 0.6}));
    const MappingFunction mapping = mapping_of(model.volume);
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::array<std::size_t, 3> outcomes{};
    for (int i = 0; i < 2000; ++i) {
        const std::array<double, 3> x{uniform(random), uniform(random), uniform(random)};
        const Inversion inversion = invert_mapping(ELVIS_SHAPE_TETRAHEDRON, mapping, x);
        ++outcomes[static_cast<std::size_t>(inversion.outcome)];
        if (inversion.outcome != Inversion::Outcome::inside)
            continue;
        // Whatever is called inside is a solution.
        const Vector image = model.volume.position(0, {inversion.xi[0], inversion.xi[1], inversion.xi[2]});
        REQUIRE((image - Vector(x[0], x[1], x[2])).norm() < 1e-12);
    }
    INFO("inside " << outcomes[0] << ", outside " << outcomes[1] << ", failed " << outcomes[2]);
    CHECK(outcomes[0] > 100);
    CHECK(outcomes[1] > 500);
}

} // namespace elvis::oracle
