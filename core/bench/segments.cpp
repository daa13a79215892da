#include <core/bench/bench.hpp>

#include <core/render/segments/segment_pass.hpp>

namespace elvis {

namespace {

constexpr int n_segment_runs = 3;

} // namespace

void bench_segments(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                    const std::vector<std::uint32_t>& elements_a_side, const std::vector<std::uint32_t>& sizes,
                    const std::function<void(const SegmentsResult&)>& report) {
    for (const std::uint32_t n : elements_a_side) {
        const RuntimeVolume volume = waves_volume(registry, folder, n, 3);
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            DeviceVolume data(device, volume, precision, nullptr);
            data.select(0, 0, {0.0});
            SegmentPass pass(device, volume, data);
            for (const std::uint32_t size : sizes) {
                const FrameRequest picture = waves_cut_plane(size);
                const CutPlaneGeometry view = cut_plane_geometry(std::get<CutPlane>(picture.surfaces.front().geometry),
                                                                 picture.camera, size, size, data.centre());
                SegmentsResult result;
                result.elements_a_side = n;
                result.size = size;
                result.precision = precision;
                for (int run = 0; run < n_segment_runs; ++run) {
                    SegmentCounts counts;
                    pass.lengths(view, {picture.camera.eye, {}}, size, size, counts);
                    const bool is_least = run == 0 || counts.milliseconds < result.milliseconds;
                    result.milliseconds = is_least ? counts.milliseconds : result.milliseconds;
                    result.n_segments = counts.segments;
                    result.n_overlaps = counts.overlaps;
                    result.n_failures = counts.failures;
                    result.n_breaks = counts.breaks;
                    result.n_undecided = counts.undecided;
                    result.evaluations_a_segment =
                        static_cast<double>(counts.evaluations) / static_cast<double>(counts.segments);
                    result.seek_evaluations_a_ray =
                        static_cast<double>(counts.seek_evaluations) / (static_cast<double>(size) * size);
                }
                report(result);
            }
        }
    }
}

} // namespace elvis
