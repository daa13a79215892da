#include <core/bench/bench.hpp>

#include <core/render/segment_pass.hpp>

#include <cmath>
#include <numbers>

namespace elvis {

namespace {

constexpr int n_runs = 3;

/** Those of the waves scene's picture, as in the scene file's formulas. */
std::vector<SegmentRay> picture_rays(std::uint32_t size, const std::array<double, 3>& centre, Precision precision) {
    const Camera camera = waves_cut_plane(size).camera;
    const auto unit = [](const Vector3& v) {
        const double norm = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        return Vector3{v[0] / norm, v[1] / norm, v[2] / norm};
    };
    const auto cross = [](const Vector3& a, const Vector3& b) {
        return Vector3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const Vector3 eye = camera.eye;
    const Vector3 axis = unit({camera.look_at[0] - eye[0], camera.look_at[1] - eye[1], camera.look_at[2] - eye[2]});
    const Vector3 right = unit(cross(axis, camera.up)), top = cross(right, axis);
    const double spread = std::tan(camera.field_of_view * std::numbers::pi / 360);
    std::vector<SegmentRay> rays;
    for (std::uint32_t row = 0; row < size; ++row) {
        for (std::uint32_t column = 0; column < size; ++column) {
            const double s = spread * (2 * (column + 0.5) / size - 1), v = spread * (1 - 2 * (row + 0.5) / size);
            Vector3 towards{};
            for (std::size_t i = 0; i < 3; ++i) {
                towards[i] = eye[i] + axis[i] + s * right[i] + v * top[i];
            }
            rays.push_back(near_centre(eye, towards, centre, precision));
        }
    }
    return rays;
}

} // namespace

void bench_segments(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                    const std::vector<std::uint32_t>& elements_a_side, const std::vector<std::uint32_t>& sizes,
                    const std::function<void(const SegmentsResult&)>& report) {
    for (const std::uint32_t n : elements_a_side) {
        const RuntimeVolume volume = waves_volume(registry, folder, n, 3);
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            DeviceVolume data(device, volume, precision, nullptr);
            data.select(0, 0, {0.0});
            const SegmentPass pass(device, volume, data);
            for (const std::uint32_t size : sizes) {
                const std::vector<SegmentRay> rays = picture_rays(size, data.centre(), precision);
                SegmentsResult result;
                result.elements_a_side = n;
                result.size = size;
                result.precision = precision;
                for (int run = 0; run < n_runs; ++run) {
                    SegmentCounts counts;
                    pass.lengths(rays, counts);
                    const bool is_least = run == 0 || counts.milliseconds < result.milliseconds;
                    result.milliseconds = is_least ? counts.milliseconds : result.milliseconds;
                    result.n_segments = counts.segments;
                    result.n_overlaps = counts.overlaps;
                    result.n_failures = counts.failures;
                    result.n_breaks = counts.breaks;
                    result.evaluations_a_segment =
                        static_cast<double>(counts.evaluations) / static_cast<double>(counts.segments);
                    result.turns_a_segment = static_cast<double>(counts.turns) / static_cast<double>(counts.segments);
                }
                report(result);
            }
        }
    }
}

} // namespace elvis
