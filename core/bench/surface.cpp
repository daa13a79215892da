#include <core/bench/bench.hpp>
#include <core/bench/repeated_frame.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis {

namespace {

constexpr int n_runs = 9;
/** The unit of the prototype's times, in nanoseconds. */
constexpr double prototype_unit = 550;

struct PrototypeTimes {
    std::uint32_t elements_a_side, order, size;
    /** Of the cut plane, the boundary, the large isosurface and the blobs. */
    std::array<double, 4> milliseconds;
};
/** Measured before this program was written, on two cores. */
constexpr std::array<PrototypeTimes, 12> prototypes{{
    {16, 3, 512, {14, 28, 193, 141}},
    {16, 3, 1024, {50, 95, 611, 431}},
    {16, 6, 512, {22, 37, 477, 334}},
    {16, 6, 1024, {79, 123, 1610, 1165}},
    {16, 8, 512, {36, 45, 958, 658}},
    {16, 8, 1024, {139, 181, 3593, 2589}},
    {32, 3, 512, {17, 34, 229, 163}},
    {32, 3, 1024, {60, 123, 766, 551}},
    {32, 6, 512, {24, 44, 548, 390}},
    {32, 6, 1024, {105, 167, 1896, 1211}},
    {32, 8, 512, {41, 61, 1106, 713}},
    {32, 8, 1024, {154, 193, 3690, 2482}},
}};

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

double prototype_milliseconds(BenchView view, std::uint32_t elements_a_side, std::uint32_t order, std::uint32_t size) {
    // Without skipping, the blobs are compared with the same figure.
    const std::size_t column = std::min(static_cast<std::size_t>(view), std::size_t{3});
    for (const PrototypeTimes& times : prototypes) {
        if (times.elements_a_side == elements_a_side && times.order == order && times.size == size) {
            return times.milliseconds[column];
        }
    }
    return 0;
}

} // namespace

void bench_surface(const Device& device, const PluginRegistry& registry, const BenchFolder& folder, BenchView view,
                   const std::vector<std::uint32_t>& elements_a_side, const std::vector<std::uint32_t>& orders,
                   const std::vector<std::uint32_t>& sizes, double unit_nanoseconds,
                   const std::function<void(const SurfaceResult&)>& report) {
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
                const RepeatedFrame repeated = render_repeatedly(renderer, request, n_runs);
                const Frame& frame = repeated.frame;
                result.milliseconds = repeated.milliseconds;
                result.wall_milliseconds = repeated.wall_milliseconds;
                const double prototype = prototype_milliseconds(view, n, order, size);
                result.ratio_to_prototype =
                    prototype > 0 ? result.milliseconds / unit_nanoseconds / (prototype / prototype_unit) : 0;
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
