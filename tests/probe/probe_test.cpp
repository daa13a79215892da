// Probed values and gradients against exact ones.
#include <core/oracle/picture/picture.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/expression/expression.hpp>
#include <core/plugin_host/all_bounds.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/probe/probe.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

namespace elvis::oracle {
namespace {

using native::Shape;

const std::array<Shape, 4> shapes{Shape::hexahedron, Shape::prism, Shape::pyramid, Shape::tetrahedron};

// A polynomial of total degree n with its gradient: sum over k of a power of a linear form.
struct Polynomial {
    int degree;

    static Vector form(int k) { return {0.7 - 0.3 * k, 0.2 + 0.25 * k, 0.5 - 0.1 * k * k}; }
    double operator()(const Vector& x) const {
        double sum = 0.5;
        for (int k = 0; k < 3; ++k)
            sum += std::pow(0.2 + form(k).dot(x), degree);
        return sum;
    }
    Vector gradient(const Vector& x) const {
        Vector sum = Vector::Zero();
        for (int k = 0; k < 3 && degree > 0; ++k)
            sum += degree * std::pow(0.2 + form(k).dot(x), degree - 1) * form(k);
        return sum;
    }
};

struct Errors {
    double value = 0;
    double gradient = 0;
};

// Probes 40 points of the bent or straight cube; errors relative to the largest value and gradient.
Errors probe_errors(Shape shape, bool is_curved, int order, ProbeOptions::Evaluation evaluation) {
    const Polynomial polynomial{is_curved ? order / 2 : order};
    const auto bend = [&](const Vector& x) -> Vector { return is_curved ? quadratic_bend(x) : x; };
    VolumeData data;
    data.classes.push_back(make_class(space_of(shape, is_curved ? 2 : 1), space_of(shape, static_cast<std::uint32_t>(order)),
                                      compose(cube(shape, 2), bend), polynomial));
    const TemporaryFile file("probe.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    ProbeOptions options;
    options.evaluation = evaluation;
    Prober prober(volume, options);

    std::mt19937_64 random(static_cast<std::uint64_t>(order));
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<std::array<double, 3>> positions;
    for (int i = 0; i < 40; ++i) {
        const Vector x = bend({uniform(random), uniform(random), uniform(random)});
        positions.push_back({x[0], x[1], x[2]});
    }
    const std::vector<ProbedPoint> points = prober.probe(positions, 0);
    Errors errors;
    Errors largest{1e-300, 1e-300};
    for (const ProbedPoint& point : points) {
        REQUIRE(point.element.has_value());
        REQUIRE(point.n_failures == 0);
        const Vector x(point.position[0], point.position[1], point.position[2]);
        const FieldSample& sample = point.fields.at(0);
        const Vector gradient(sample.gradients[0], sample.gradients[1], sample.gradients[2]);
        errors.value = std::max(errors.value, std::abs(sample.values[0] - polynomial(x)));
        errors.gradient = std::max(errors.gradient, (gradient - polynomial.gradient(x)).norm());
        largest.value = std::max(largest.value, std::abs(polynomial(x)));
        largest.gradient = std::max(largest.gradient, polynomial.gradient(x).norm());
    }
    return {errors.value / largest.value, polynomial.degree == 0 ? errors.gradient : errors.gradient / largest.gradient};
}

struct Orders {
    std::vector<int> straight, curved;
};

void check_orders(ProbeOptions::Evaluation evaluation, const Orders& orders) {
    for (const Shape shape : shapes)
        for (const bool is_curved : {false, true}) {
            Errors largest;
            for (const int order : is_curved ? orders.curved : orders.straight) {
                const Errors errors = probe_errors(shape, is_curved, order, evaluation);
                CAPTURE(native::name(shape), is_curved, order, errors.value, errors.gradient);
                CHECK(errors.value <= 1e-11);
                CHECK(errors.gradient <= 1e-9);
                largest.value = std::max(largest.value, errors.value);
                largest.gradient = std::max(largest.gradient, errors.gradient);
            }
            WARN(native::name(shape) << (is_curved ? ", curved" : ", straight") << ": value error " << largest.value
                                     << ", gradient error " << largest.gradient);
        }
}

const std::vector<int> all_orders{1, 2, 3, 4, 5, 6, 7, 8};

} // namespace

TEST_CASE("probed polynomials are exact in every shape and order") {
    check_orders(ProbeOptions::Evaluation::cpu, {all_orders, all_orders});
}

// Each order has kernels of its own, which take their time to compile.
TEST_CASE("probing on the device is as exact as on the CPU") { check_orders(ProbeOptions::Evaluation::device, {{1}, {6}}); }

TEST_CASE("probing on the device is exact in every order", "[.long]") {
    check_orders(ProbeOptions::Evaluation::device, {all_orders, all_orders});
}

TEST_CASE("generated polynomials are probed exactly from the order that holds them") {
    // Sum of x^i y^j z^k / (1 + i + 2j + 3k), i + j + k <= degree, and its gradient.
    const auto exact = [](int degree, const Vector& x) {
        std::array<double, 4> result{};
        for (int i = 0; i <= degree; ++i)
            for (int j = 0; i + j <= degree; ++j)
                for (int k = 0; i + j + k <= degree; ++k) {
                    const double c = 1.0 / (1 + i + 2 * j + 3 * k);
                    const double px = std::pow(x.x(), i);
                    const double py = std::pow(x.y(), j);
                    const double pz = std::pow(x.z(), k);
                    result[0] += c * px * py * pz;
                    result[1] += i == 0 ? 0 : c * i * std::pow(x.x(), i - 1) * py * pz;
                    result[2] += j == 0 ? 0 : c * j * px * std::pow(x.y(), j - 1) * pz;
                    result[3] += k == 0 ? 0 : c * k * px * py * std::pow(x.z(), k - 1);
                }
        return result;
    };
    for (const Shape shape : shapes)
        for (const bool is_curved : {false, true}) {
            Errors largest;
            for (int order = 1; order <= 8; ++order) {
                const int geometry_order = is_curved ? 2 : 1;
                const int degree = order / geometry_order;
                if (degree == 0)
                    continue;
                const auto text = [&](int chosen_order) {
                    return std::string(R"({"generator":1,"elements":2,"field":"polynomial","mesh":")") +
                           (is_curved ? "ball" : "box") + R"(","shape":")" + std::string(native::name(shape)) +
                           R"(","geometry_order":)" + std::to_string(geometry_order) + R"(,"degree":)" +
                           std::to_string(degree) + R"(,"order":)" + std::to_string(chosen_order) + "}";
                };
                const TemporaryFile file("generated.h5");
                CAPTURE(text(order));
                if (const int lower = degree * geometry_order - 1; lower > 0)
                    CHECK_FALSE(generate(text(lower), file.path()).fields[0].exact);
                CHECK(generate(text(order), file.path()).fields[0].exact);
                const RuntimeVolume volume = open_volume(file.path());
                std::mt19937_64 random(static_cast<std::uint64_t>(order));
                std::uniform_real_distribution<double> uniform(-0.57, 0.57);
                std::vector<std::array<double, 3>> positions(40);
                for (auto& position : positions)
                    position = {uniform(random), uniform(random), uniform(random)};
                Errors errors;
                Errors scale{1e-300, 1e-300};
                for (const ProbedPoint& point : Prober(volume).probe(positions, 0)) {
                    REQUIRE(point.element.has_value());
                    const Vector x(point.position[0], point.position[1], point.position[2]);
                    const auto expected = exact(degree, x);
                    const FieldSample& sample = point.fields.at(0);
                    const Vector gradient(sample.gradients[0], sample.gradients[1], sample.gradients[2]);
                    const Vector expected_gradient(expected[1], expected[2], expected[3]);
                    errors.value = std::max(errors.value, std::abs(sample.values[0] - expected[0]));
                    errors.gradient = std::max(errors.gradient, (gradient - expected_gradient).norm());
                    scale.value = std::max(scale.value, std::abs(expected[0]));
                    scale.gradient = std::max(scale.gradient, expected_gradient.norm());
                }
                CHECK(errors.value <= 1e-11 * scale.value);
                CHECK(errors.gradient <= 1e-9 * scale.gradient);
                largest.value = std::max(largest.value, errors.value / scale.value);
                largest.gradient = std::max(largest.gradient, errors.gradient / scale.gradient);
            }
            WARN("generated, " << native::name(shape) << (is_curved ? ", ball" : ", box") << ": value error " << largest.value
                               << ", gradient error " << largest.gradient);
        }
}

TEST_CASE("a plugin with nothing but the required snippet functions is probed on the device") {
    const RuntimeVolume volume = open_volume(ELVIS_ANALYTIC_SAMPLE);
    REQUIRE_FALSE(volume.has_evaluation());
    Prober prober(volume);
    const std::uint32_t wave = volume.field_index("wave");
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-0.6, 0.6);
    std::vector<std::array<double, 3>> positions(60);
    for (auto& position : positions)
        position = {uniform(random), uniform(random), uniform(random)};
    Errors largest;
    for (const ProbedPoint& point : prober.probe(positions, 0)) {
        REQUIRE(point.element.has_value());
        const auto [x, y, z] = point.position;
        const double first = 3 * x + 2 * y + z + 0.5;
        const double second = -x + 5 * y + 2 * z;
        const Vector gradient = std::cos(first) * Vector(3, 2, 1) + 0.25 * std::cos(second) * Vector(-1, 5, 2);
        const FieldSample& sample = point.fields.at(wave);
        REQUIRE(sample.gradient_is_estimated);
        largest.value = std::max(largest.value, std::abs(sample.values[0] - std::sin(first) - 0.25 * std::sin(second)));
        largest.gradient = std::max(largest.gradient,
                                    (Vector(sample.gradients[0], sample.gradients[1], sample.gradients[2]) - gradient).norm());
    }
    WARN("analytic plugin: value error " << largest.value << ", gradient error " << largest.gradient);
    CHECK(largest.value < 1e-13);
    // Differences of sixth order, see shaders/field/gradient_default.glsl.
    CHECK(largest.gradient < 1e-9);
}

TEST_CASE("expressions are probed on the CPU and on the device, with their gradients") {
    const auto polynomial = [](const Vector& x) { return x.x() * x.x() * x.y() + 2 * x.z() * x.z() - x.x() * x.y() * x.z(); };
    VolumeData data;
    // Trilinear elements hold quadratic polynomials of x at order 6.
    data.classes.push_back(
        make_class(space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 6), cube(Shape::hexahedron, 2), polynomial));
    const TemporaryFile file("expressions.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    std::vector<std::shared_ptr<const Expression>> expressions;
    for (const char* text : {"d(u, x) * u", "laplacian(u)", "u + x", "d(laplacian(u) * 0 + d(u, z), y)"})
        expressions.push_back(std::make_shared<const Expression>(text, volume.fields()));
    const std::array<double, 3> at{0.31, 0.22, 0.77};
    const auto [x, y, z] = at;
    const double u = polynomial(Vector(x, y, z));
    const Vector slope(2 * x * y - y * z, x * x - x * z, 4 * z - x * y);
    const std::array<double, 4> values{slope.x() * u, 2 * y + 4, u + x, -x};
    const std::array<Vector, 4> gradients{slope.x() * slope + u * Vector(2 * y, 2 * x - z, -y), Vector(0, 2, 0),
                                          slope + Vector(1, 0, 0), Vector(-1, 0, 0)};
    for (const auto evaluation : {ProbeOptions::Evaluation::cpu, ProbeOptions::Evaluation::device}) {
        ProbeOptions options;
        options.evaluation = evaluation;
        const bool on_cpu = evaluation == ProbeOptions::Evaluation::cpu;
        const std::vector<ProbedPoint> points = Prober(volume, options).probe(std::span(&at, 1), 0, {{}, expressions});
        REQUIRE(points[0].expressions.size() == expressions.size());
        for (std::size_t i = 0; i < expressions.size(); ++i) {
            const ExpressionSample& sample = points[0].expressions[i];
            INFO(expressions[i]->text());
            CHECK(sample.value == Approx(values[i]).margin(1e-9));
            // Gradients of second derivatives are differences, of differences on the CPU.
            for (int axis = 0; axis < 3; ++axis)
                CHECK(sample.gradient[static_cast<std::size_t>(axis)] == Approx(gradients[i][axis]).margin(1e-7));
            CHECK(sample.value_is_estimated == (on_cpu && i % 2 == 1));
            CHECK(sample.gradient_is_estimated == (i % 2 == 1 || (on_cpu && i == 0)));
        }
    }
}

TEST_CASE("a probed point on shared faces reports the lowest element and the others") {
    VolumeData data;
    data.classes.push_back(make_class(space_of(Shape::hexahedron, 1), space_of(Shape::hexahedron, 1),
                                      cube(Shape::hexahedron, 2), [](const Vector& x) { return x.x(); }));
    // Numbers in the reverse order of positions: the lowest number is not the first element.
    for (std::size_t i = 0; i < 8; ++i)
        data.classes[0].numbers[i] = static_cast<std::int64_t>(7 - i);
    const TemporaryFile file("shared.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    Prober prober(volume);
    const std::vector<std::array<double, 3>> positions{{0.5, 0.5, 0.5}, {0.25, 0.25, 0.5},     {0.1, 0.2, 0.3},
                                                       {0, 0, 0},       {1.0000001, 0.5, 0.5}, {std::nan(""), 0, 0}};
    const auto points = prober.probe(positions, 0);
    CHECK(points[0].element == 0);
    CHECK(points[0].also == std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 7});
    CHECK(points[1].element == 3);
    CHECK(points[1].also == std::vector<std::int64_t>{7});
    CHECK(points[2].element == 7);
    CHECK(points[2].also.empty());
    CHECK(points[3].element == 7);
    CHECK_FALSE(points[4].element.has_value());
    CHECK(points[4].fields.empty());
    CHECK_FALSE(points[5].element.has_value());
    CHECK_THROWS_WITH(prober.probe(positions, 7), Catch::Contains("time step 7"));
}

TEST_CASE("bounds that several threads ask for are those of all elements, each in its place") {
    // More than one thread asks for at once.
    const TemporaryFile file("many.h5");
    generate(R"({"generator": 1, "mesh": "waves", "shape": "mixed", "elements": [12, 12, 12], "order": 1, "field": "sphere"})",
             file.path());
    const RuntimeVolume volume = open_volume(file.path());
    REQUIRE(volume.n_elements() > 4096);
    std::vector<double> boxes(6 * volume.n_elements());
    const elvis_certainty certainty = volume.bounds(0, volume.n_elements(), boxes);
    elvis_certainty shared = ELVIS_ESTIMATED;
    CHECK((all_bounds(volume, shared) == boxes));
    CHECK(shared == certainty);
}

} // namespace elvis::oracle
