/*
 * Rays through elements that are only parts of their reference shape, and the volumes that they gather, against closed forms.
 */
#include "closed_forms.hpp"

#include <core/render/segments/segment_pass.hpp>

#include <catch2/catch.hpp>

#include <random>

using namespace elvis;
using namespace elvis::cut_cells;

namespace {

/** White light of a density that is the same everywhere. */
VolumeRendering constant_density(const RuntimeVolume& volume, const char* field, double density) {
    VolumeRendering rendering;
    rendering.field.field = field_of(volume, field);
    rendering.transfer.density = {{0, density}};
    rendering.transfer.color = {{0, {1, 1, 1}}};
    return rendering;
}

/** How much of a ray lies in elements. */
double length_of(const std::vector<Segment>& segments) {
    double length = 0;
    for (const Segment& segment : segments) {
        length += segment.leave - segment.enter;
    }
    return length;
}

} // namespace

TEST_CASE("the parts of rays in a cut ball are its chords") {
    const RuntimeVolume volume = open(ball);
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    DeviceVolume data(test::device(), volume, precision, nullptr);
    data.select(0, 0, {0.0});
    SegmentPass pass(test::device(), volume, data);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    std::vector<SegmentRay> rays;
    std::vector<double> chords;
    for (int i = 0; i < 2000; ++i) {
        const Vector3 eye = View::unit({uniform(random), uniform(random), uniform(random)});
        Vector3 from{}, to{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            from[axis] = 4 * eye[axis];
            to[axis] = 0.8 * uniform(random);
        }
        rays.push_back(near_centre(from, to, data.centre(), precision));
        double square = 0, along = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double x = rays.back().origin[axis] + data.centre()[axis];
            square += x * x;
            along += x * rays.back().direction[axis];
        }
        chords.push_back(2 * std::sqrt(std::max(radius * radius - square + along * along, 0.0)));
    }
    SegmentCounts counts;
    const auto lists = pass.lists(rays, counts);
    double worst = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const double sum = length_of(lists[i].segments);
        // Beside the silhouette a chord depends on its distance from the middle as a square root does.
        worst = chords[i] > 0.05 ? std::max(worst, std::abs(sum - chords[i])) : worst;
    }
    CAPTURE(worst, counts.segments, counts.evaluations);
    CHECK(counts.failures == 0);
    CHECK(worst < (precision == Precision::float64 ? 1e-11 : 1e-5));
}

TEST_CASE("a cut ball of constant density keeps exp(-density chord) of the light") {
    const RuntimeVolume volume = open(ball);
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    View view;
    view.request.background = {0, 0, 0, 1};
    constexpr double density = 1.7;
    view.request.volume = constant_density(volume, "u", density);
    const Frame frame = Renderer(test::device(), volume, precision).render(view.request);
    double worst = 0;
    int n_hit = 0;
    for (std::size_t pixel = 0; pixel < frame.flags.size(); ++pixel) {
        const auto [near, far] = view.through_sphere(pixel, radius);
        const double expected = std::isnan(near) ? 0 : 1 - std::exp(-density * (far - near));
        worst = std::max(worst, std::abs(frame.color[4 * pixel] - expected));
        n_hit += std::isnan(near) ? 0 : 1;
    }
    CAPTURE(n_hit, frame.counts.volume_segments, frame.counts.mapping_evaluations);
    CHECK(n_hit > 4000);
    CHECK(worst < (precision == Precision::float64 ? 1e-9 : 1e-4));
    CHECK(frame.counts.undecided_pixels <= 2);
}

TEST_CASE("light begins at the eye inside of a cut cell, on either side of the cut") {
    const RuntimeVolume volume = open(ball);
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    // In a cell of which a part is there: in that part, and in the other one.
    const double place = GENERATE(0.44, 0.49);
    FrameRequest request;
    request.width = request.height = 48;
    request.background = {0, 0, 0, 1};
    request.camera.eye = {place, place, place};
    request.camera.look_at = {0.1, -0.2, 0.05};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 90;
    constexpr double density = 1.2;
    request.volume = constant_density(volume, "u", density);
    const Frame frame = Renderer(test::device(), volume, precision).render(request);
    Vector3 axis{};
    for (std::size_t i = 0; i < 3; ++i) {
        axis[i] = request.camera.look_at[i] - place;
    }
    axis = View::unit(axis);
    const Vector3 right = View::unit(View::cross(axis, request.camera.up)), top = View::cross(right, axis);
    double worst = 0;
    for (std::size_t pixel = 0; pixel < frame.flags.size(); ++pixel) {
        const double s = 2 * (static_cast<double>(pixel % 48) + 0.5) / 48 - 1,
                     v = 1 - 2 * (static_cast<double>(pixel / 48) + 0.5) / 48;
        const Vector3 d = View::unit(
            {axis[0] + s * right[0] + v * top[0], axis[1] + s * right[1] + v * top[1], axis[2] + s * right[2] + v * top[2]});
        const double along = -place * (d[0] + d[1] + d[2]), under = radius * radius - 3 * place * place + along * along;
        const double from = std::max(along - std::sqrt(std::max(under, 0.0)), 0.0),
                     to = std::max(along + std::sqrt(std::max(under, 0.0)), 0.0);
        const double expected = under > 0 ? 1 - std::exp(-density * (to - from)) : 0;
        // Where a ray grazes the sphere, a chord is as uncertain as a square root.
        worst = under > 1e-4 || under < 0 ? std::max(worst, std::abs(frame.color[4 * pixel] - expected)) : worst;
    }
    CAPTURE(place, frame.counts.undecided_pixels);
    CHECK(worst < (precision == Precision::float64 ? 1e-9 : 2e-4));
    CHECK(frame.counts.work_limit_pixels == 0);
}

TEST_CASE("volumes of a cut gyroid are those of its parts of rays") {
    const RuntimeVolume volume = open(gyroid);
    View view;
    view.request.camera.height = 11;
    for (double& coordinate : view.request.camera.eye) {
        coordinate *= 4;
    }
    view.request.background = {0, 0, 0, 1};
    constexpr double density = 0.3;
    view.request.volume = constant_density(volume, "p", density);
    DeviceVolume data(test::device(), volume, Precision::float64, nullptr);
    data.select(0, 0, {0.0});
    std::vector<SegmentRay> rays;
    for (std::size_t pixel = 0; pixel < std::size_t{view.request.width} * view.request.height; ++pixel) {
        Vector3 from = view.origin(pixel), to = from;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            to[axis] += view.along[axis];
        }
        rays.push_back(near_centre(from, to, data.centre(), Precision::float64));
    }
    SegmentCounts counts;
    const auto lists = SegmentPass(test::device(), volume, data).lists(rays, counts);
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const Frame frame = Renderer(test::device(), volume, precision).render(view.request);
    std::size_t n_wrong = 0;
    for (std::size_t pixel = 0; pixel < frame.flags.size(); ++pixel) {
        const double length = length_of(lists[pixel].segments);
        const bool is_wrong = !(std::abs(frame.color[4 * pixel] - (1 - std::exp(-density * length))) < 1e-3);
        n_wrong += is_wrong ? 1 : 0;
    }
    CAPTURE(frame.counts.undecided_pixels, frame.counts.mapping_evaluations, counts.failures);
    CHECK(frame.counts.volume_pixels > 2000);
    CHECK(n_wrong == 0);
}

TEST_CASE("parts of rays in a cut gyroid are where its level set is not positive") {
    const RuntimeVolume volume = open(gyroid);
    DeviceVolume data(test::device(), volume, Precision::float64, nullptr);
    data.select(0, 0, {0.0});
    SegmentPass pass(test::device(), volume, data);
    const LevelSet level(volume, 5);
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(-3, 3);
    std::vector<SegmentRay> rays;
    for (int i = 0; i < 150; ++i) {
        Vector3 from{}, to{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            from[axis] = 12 * View::unit({uniform(random), uniform(random), uniform(random)})[axis];
            to[axis] = uniform(random);
        }
        rays.push_back(near_centre(from, to, data.centre(), Precision::float64));
    }
    SegmentCounts counts;
    const auto lists = pass.lists(rays, counts);
    std::size_t n_inside = 0, n_wrong = 0, n_parts = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        n_parts += lists[i].segments.size();
        constexpr double step = 0.004;
        for (double t = -6; t < 6; t += step) {
            Vector3 x{};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                x[axis] = rays[i].origin[axis] + data.centre()[axis] + t * rays[i].direction[axis];
            }
            const double g = level.at(x);
            bool is_in_segment = false;
            for (const Segment& segment : lists[i].segments) {
                is_in_segment = is_in_segment || (t >= segment.enter && t <= segment.leave);
            }
            n_inside += g <= 0 ? 1 : 0;
            n_wrong += is_in_segment != (g <= 0) && std::abs(g) > 1e-10 ? 1 : 0;
        }
    }
    CAPTURE(n_parts, counts.evaluations);
    CHECK(counts.failures == 0);
    CHECK(n_inside > 50000);
    CHECK(n_wrong == 0);
}
