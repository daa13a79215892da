/*
 * Elements that are only parts of their reference shape, in every picture, against closed forms: a ball cut out of a box.
 */
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/renderer.hpp>
#include <core/render/segment_pass.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <functional>
#include <random>

using namespace elvis;

namespace {

constexpr double radius = 0.8;
const std::string ball = CUT_CELLS_SAMPLES "/ball.cut";

RuntimeVolume open(const std::string& path) { return RuntimeVolume(Plugin::load(CUT_CELLS_PLUGIN), path); }

const Device& device() {
    static const Device the_device;
    return the_device;
}

/** The ray through a pixel's middle, of a parallel view along `along`, from a plane through `eye`. */
struct View {
    FrameRequest request;
    Vector3 along{}, right{}, top{};

    View() {
        request.width = 120;
        request.height = 90;
        request.camera.orthographic = true;
        request.camera.eye = {1.3, 0.7, 2.9};
        request.camera.up = {0, 1, 0};
        request.camera.height = 1.9;
        along = unit({-1.3, -0.7, -2.9});
        right = unit(cross(along, request.camera.up));
        top = cross(right, along);
    }

    static Vector3 unit(const Vector3& v) {
        const double size = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        return {v[0] / size, v[1] / size, v[2] / size};
    }
    static Vector3 cross(const Vector3& a, const Vector3& b) {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }

    Vector3 origin(std::size_t pixel) const {
        const double column = static_cast<double>(pixel % request.width), row = static_cast<double>(pixel / request.width);
        const double s = (2 * (column + 0.5) / request.width - 1) * request.width / request.height;
        const double v = 1 - 2 * (row + 0.5) / request.height;
        Vector3 x = request.camera.eye;
        for (std::size_t i = 0; i < 3; ++i) {
            x[i] += 0.5 * request.camera.height * (s * right[i] + v * top[i]);
        }
        return x;
    }

    /** Where the ray meets the sphere about the origin; NaN if it does not. */
    std::array<double, 2> through_sphere(std::size_t pixel, double r) const {
        const Vector3 x = origin(pixel);
        double middle = 0, square = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            middle -= x[i] * along[i];
            square += x[i] * x[i];
        }
        const double half = std::sqrt(r * r - (square - middle * middle));
        return {middle - half, middle + half};
    }
};

std::uint32_t field_of(const RuntimeVolume& volume, const char* name) { return volume.field_index(name); }

} // namespace

TEST_CASE("the parts of rays in a cut ball are its chords") {
    const RuntimeVolume volume = open(ball);
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    DeviceVolume data(device(), volume, precision, nullptr);
    data.select(0, 0, {0.0});
    const SegmentPass pass(device(), volume, data);
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
    int n_wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        double sum = 0;
        for (const Segment& segment : lists[i]) {
            sum += segment.leave - segment.enter;
        }
        // Beside the silhouette a chord depends on its distance from the middle as a square root does.
        if (chords[i] > 0.05) {
            const double error = std::abs(sum - chords[i]);
            worst = std::max(worst, error);
            if (error > 1e-5) {
                ++n_wrong;
            }
        }
    }
    CAPTURE(worst, counts.failures, counts.segments, counts.evaluations, counts.breaks, counts.overlaps);
    CHECK(n_wrong == 0);
    CHECK(worst < (precision == Precision::float64 ? 1e-11 : 1e-5));
}

TEST_CASE("a cut ball of constant density keeps exp(-density chord) of the light") {
    const RuntimeVolume volume = open(ball);
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    View view;
    view.request.background = {0, 0, 0, 1};
    VolumeRendering rendering;
    rendering.field.field = field_of(volume, "u");
    constexpr double density = 1.7;
    rendering.transfer.density = {{0, density}};
    rendering.transfer.color = {{0, {1, 1, 1}}};
    view.request.volume = rendering;
    const Frame frame = Renderer(device(), volume, precision).render(view.request);
    double worst = 0;
    int n_wrong = 0, n_hit = 0;
    for (std::size_t pixel = 0; pixel < frame.flags.size(); ++pixel) {
        const auto [near, far] = view.through_sphere(pixel, radius);
        const double expected = std::isnan(near) ? 0 : 1 - std::exp(-density * (far - near));
        const double error = std::abs(frame.color[4 * pixel] - expected);
        worst = std::max(worst, error);
        n_wrong += error > 1e-3 ? 1 : 0;
        n_hit += std::isnan(near) ? 0 : 1;
    }
    CAPTURE(n_hit, worst, frame.counts.undecided_pixels, frame.counts.volume_segments, frame.counts.mapping_evaluations);
    CHECK(n_wrong == 0);
    CHECK(frame.counts.undecided_pixels == 0);
}
