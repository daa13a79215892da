// Pictures of expressions against the oracle's, which computes what they mean by itself.
#include <core/oracle/picture/compare.hpp>
#include <core/oracle/picture/view.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/expression/expression.hpp>
#include <core/render/renderer.hpp>

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::oracle {
namespace {

double wavy(const Vector& x) { return std::sin(3 * x.x()) * std::cos(2 * x.y()) + std::sin(2.5 * x.z() + x.x() * x.y()); }

/** World gradient by differences of sixth order along xi: 1e-12 of it; steps are short because functions of pyramids are
 * rational. */
Vector world_gradient(const Volume& volume, std::size_t element, const Vector& xi) {
    constexpr double h = 1e-3;
    constexpr double weights[] = {45.0 / 60, -9.0 / 60, 1.0 / 60};
    Vector slope = Vector::Zero();
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 1; k <= 3; ++k) {
            const Vector step = k * h * Vector::Unit(axis);
            slope[axis] += weights[k - 1] * (volume.field(element, xi + step)[0] - volume.field(element, xi - step)[0]) / h;
        }
    Matrix jacobian;
    volume.position(element, xi, &jacobian);
    return jacobian.transpose().inverse() * slope;
}

void check(const std::string& text, const ValueFunction& value, double float32_tolerance) {
    VolumeData data = mixed_volume(2, 4, wavy);
    const TemporaryFile file("expression.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    const Model model(std::move(data));
    const CutPlane plane{{1, 0.7, 0.5, -1.1}};
    FrameRequest request = view_of(model, plane, 120, 120, 0, 1);
    const auto [low, high] = value_range(draw(model, request, 1e-6, value));
    request.surfaces[0].colors = view_of(model, plane, 1, 1, low, high).surfaces[0].colors;
    const Picture exact = draw(model, request, 1e-6, value);
    request.surfaces[0].field.expression = std::make_shared<const Expression>(text, volume.fields());
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        Renderer renderer(device(), volume, precision);
        const Frame frame = renderer.render(request);
        const Comparison comparison = compare(model, exact, frame);
        const bool is_single = precision == Precision::float32;
        WARN(text << (is_single ? ", float32: " : ", float64: ") << to_text(comparison));
        CHECK(comparison.both_inside > comparison.pixels / 20);
        CHECK(comparison.max_channel_error <= (is_single ? float32_tolerance : 1e-9));
        CHECK(frame.counts.estimated_pixels == 0);
        // Sampled: within what is seen, and not far beyond.
        const FieldRange range = renderer.ranges().range(request.surfaces[0].field, 0);
        CHECK(range.lower <= low + 0.05 * (high - low));
        CHECK(range.upper >= high - 0.05 * (high - low));
    }
}

} // namespace

TEST_CASE("an expression of a field and coordinates is drawn as the oracle draws it") {
    check(
        "sin(2 * u) * x + u^2 / (3 + y)",
        [](const Volume& volume, std::size_t element, const Vector& xi) {
            const double u = volume.field(element, xi)[0];
            const Vector x = volume.position(element, xi);
            return std::sin(2 * u) * x.x() + u * u / (3 + x.y());
        },
        1e-3);
}

TEST_CASE("an expression of gradients is drawn as the oracle draws it") {
    check(
        "norm(grad(u)) + 0.5 * d(u, z)",
        [](const Volume& volume, std::size_t element, const Vector& xi) {
            const Vector gradient = world_gradient(volume, element, xi);
            return gradient.norm() + 0.5 * gradient.z();
        },
        1e-3);
}

TEST_CASE("surfaces of one picture show different fields and expressions") {
    VolumeData data = mixed_volume(2, 3, wavy);
    const TemporaryFile file("expressions.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    const Model model(std::move(data));
    FrameRequest request = view_of(model, CutPlane{{1, 0, 0, -0.4}}, 60, 60, -1, 1);
    Surface second = request.surfaces[0];
    second.geometry = CutPlane{{0, 1, 0, -0.6}};
    second.field.expression = std::make_shared<const Expression>("u * 0 + x", volume.fields());
    request.surfaces.push_back(second);
    Renderer renderer(device(), volume, Precision::float64);
    const Frame both = renderer.render(request);
    const Frame again = renderer.render(request);
    request.surfaces.erase(request.surfaces.begin() + 1);
    const Frame first = renderer.render(request);
    CHECK(std::equal(both.color.begin(), both.color.end(), again.color.begin()));
    std::size_t n_second = 0, n_first = 0;
    for (std::size_t pixel = 0; pixel < both.value.size(); ++pixel) {
        if (both.element[pixel] < 0)
            continue;
        const bool is_first = both.depth[pixel] == first.depth[pixel];
        n_first += is_first;
        n_second += !is_first;
        if (is_first)
            CHECK(both.value[pixel] == first.value[pixel]);
    }
    CHECK(n_first > 100);
    CHECK(n_second > 100);
}

TEST_CASE("an expression that loses its digits in single precision is flagged") {
    VolumeData data = mixed_volume(2, 3, wavy);
    const TemporaryFile file("digits.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    const Model model(std::move(data));
    FrameRequest request = view_of(model, CutPlane{{1, 0, 0, -0.4}}, 40, 40, -1, 1);
    const auto n_flagged = [&](const char* text, Precision precision) {
        request.surfaces[0].field.expression = std::make_shared<const Expression>(text, volume.fields());
        const Frame frame = Renderer(device(), volume, precision).render(request);
        return std::count_if(frame.flags.begin(), frame.flags.end(),
                             [](std::uint32_t flags) { return (flags & pixel_flag::range_too_fine) != 0; });
    };
    // Numbers of 1e6 have an ulp of 0.06 in single precision, where colours change over 2.
    CHECK(n_flagged("(u * x + 1000000 * sin(y)) - 1000000 * sin(y)", Precision::float32) > 100);
    CHECK(n_flagged("(u * x + 1000000 * sin(y)) - 1000000 * sin(y)", Precision::float64) == 0);
    CHECK(n_flagged("(u * x + 10 * sin(y)) - 10 * sin(y)", Precision::float32) == 0);
    // Constants cancel in double precision.
    CHECK(n_flagged("(u * x + 1000000) - (1000000 + y)", Precision::float32) == 0);
}

TEST_CASE("a small variation of a large field keeps its digits in an expression") {
    const auto large = [](const Vector& x) { return 101325 + wavy(x); };
    VolumeData data = mixed_volume(2, 4, large);
    const TemporaryFile file("large.h5");
    write_volume(file.path(), data);
    const RuntimeVolume volume = open_volume(file.path());
    const Model model(std::move(data));
    const FrameRequest plain = view_of(model, CutPlane{{1, 0.7, 0.5, -1.1}}, 80, 80, -2, 2);
    const auto value = [](const Volume& of, std::size_t element, const Vector& xi) {
        return 2 * (of.field(element, xi)[0] - 101325) / 3 + 0.1;
    };
    const Picture exact = draw(model, plain, 1e-6, value);
    FrameRequest request = plain;
    request.surfaces[0].field.expression = std::make_shared<const Expression>("2 * (u - 101325) / 3 + 0.1", volume.fields());
    Renderer renderer(device(), volume, Precision::float32);
    const Frame frame = renderer.render(request);
    const Comparison comparison = compare(model, exact, frame);
    WARN(to_text(comparison));
    CHECK(comparison.max_channel_error <= 1e-5);
    CHECK(std::none_of(frame.flags.begin(), frame.flags.end(),
                       [](std::uint32_t flags) { return (flags & pixel_flag::range_too_fine) != 0; }));
}

} // namespace elvis::oracle
