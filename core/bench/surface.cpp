#include <core/bench/bench.hpp>
#include <core/bench/repeated_frame.hpp>

#include <cmath>

namespace elvis {

namespace {

constexpr int n_surface_runs = 9;
FrameRequest picture(BenchView view, std::uint32_t size) {
    switch (view) {
    case BenchView::cut_plane:
        return waves_cut_plane(size);
    case BenchView::boundary:
        return waves_boundary(size);
    case BenchView::isosurface_large:
        return waves_isosurface(size, 0, true);
    default:
        return waves_isosurface(size, 1.2, view == BenchView::isosurface_blobs);
    }
}

} // namespace

void bench_surface(const Device& device, const PluginRegistry& registry, const BenchFolder& folder, BenchView view,
                   const std::vector<std::uint32_t>& elements_a_side, const std::vector<std::uint32_t>& orders,
                   const std::vector<std::uint32_t>& sizes, const std::function<void(const SurfaceResult&)>& report) {
    for (const std::uint32_t n : elements_a_side) {
        for (const std::uint32_t order : orders) {
            const RuntimeVolume volume = waves_volume(registry, folder, n, order);
            Renderer renderer(device, volume, Precision::float32);
            for (const std::uint32_t size : sizes) {
                const FrameRequest request = picture(view, size);
                SurfaceResult result;
                result.elements_a_side = n;
                result.order = order;
                result.size = size;
                const RepeatedFrame repeated = render_repeatedly(renderer, request, n_surface_runs);
                const Frame& frame = repeated.frame;
                result.milliseconds = repeated.milliseconds;
                result.wall_milliseconds = repeated.wall_milliseconds;
                const auto pixels = static_cast<double>(frame.counts.hit_pixels);
                result.evaluations_a_pixel = static_cast<double>(frame.counts.field_evaluations) / pixels;
                result.newton_steps_a_pixel = static_cast<double>(frame.counts.newton_iterations) / pixels;
                result.undecided_share = static_cast<double>(frame.counts.undecided_isosurface_pixels) / pixels;
                result.estimated_share = static_cast<double>(frame.counts.estimated_pixels) / pixels;
                result.memory = renderer.memory();
                const auto elements = static_cast<double>(volume.n_elements());
                const double coefficients = std::pow(order + 1.0, 3) * sizeof(float);
                result.field_overhead = static_cast<double>(result.memory.field_bytes) / elements / coefficients;
                result.geometry_overhead = static_cast<double>(result.memory.geometry_bytes) / elements / (81 * sizeof(float));
                result.hierarchy_bytes_an_element = static_cast<double>(result.memory.hierarchy_bytes) / elements;
                report(result);
            }
        }
    }
}

} // namespace elvis
