#include <core/bench/bench.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis {

namespace {

constexpr int n_runs = 9;
/** The unit of the prototype's times, in nanoseconds. */
constexpr double prototype_unit = 550;

struct PrototypeTime {
    std::uint32_t elements_a_side, order, size;
    double milliseconds;
};
/** Measured before this program was written, on two cores. */
constexpr std::array<PrototypeTime, 12> prototype_cut_plane{{{16, 3, 512, 14},
                                                             {16, 3, 1024, 50},
                                                             {16, 6, 512, 22},
                                                             {16, 6, 1024, 79},
                                                             {16, 8, 512, 36},
                                                             {16, 8, 1024, 139},
                                                             {32, 3, 512, 17},
                                                             {32, 3, 1024, 60},
                                                             {32, 6, 512, 24},
                                                             {32, 6, 1024, 105},
                                                             {32, 8, 512, 41},
                                                             {32, 8, 1024, 154}}};
constexpr std::array<PrototypeTime, 12> prototype_boundary{{{16, 3, 512, 28},
                                                            {16, 3, 1024, 95},
                                                            {16, 6, 512, 37},
                                                            {16, 6, 1024, 123},
                                                            {16, 8, 512, 45},
                                                            {16, 8, 1024, 181},
                                                            {32, 3, 512, 34},
                                                            {32, 3, 1024, 123},
                                                            {32, 6, 512, 44},
                                                            {32, 6, 1024, 167},
                                                            {32, 8, 512, 61},
                                                            {32, 8, 1024, 193}}};
constexpr std::array<PrototypeTime, 12> prototype_isosurface_large{{{16, 3, 512, 193},
                                                                    {16, 3, 1024, 611},
                                                                    {16, 6, 512, 477},
                                                                    {16, 6, 1024, 1610},
                                                                    {16, 8, 512, 958},
                                                                    {16, 8, 1024, 3593},
                                                                    {32, 3, 512, 229},
                                                                    {32, 3, 1024, 766},
                                                                    {32, 6, 512, 548},
                                                                    {32, 6, 1024, 1896},
                                                                    {32, 8, 512, 1106},
                                                                    {32, 8, 1024, 3690}}};
constexpr std::array<PrototypeTime, 12> prototype_isosurface_blobs{{{16, 3, 512, 141},
                                                                    {16, 3, 1024, 431},
                                                                    {16, 6, 512, 334},
                                                                    {16, 6, 1024, 1165},
                                                                    {16, 8, 512, 658},
                                                                    {16, 8, 1024, 2589},
                                                                    {32, 3, 512, 163},
                                                                    {32, 3, 1024, 551},
                                                                    {32, 6, 512, 390},
                                                                    {32, 6, 1024, 1211},
                                                                    {32, 8, 512, 713},
                                                                    {32, 8, 1024, 2482}}};

const std::array<PrototypeTime, 12>& prototype_times(BenchView view) {
    switch (view) {
    case BenchView::cut_plane:
        return prototype_cut_plane;
    case BenchView::boundary:
        return prototype_boundary;
    case BenchView::isosurface_large:
        return prototype_isosurface_large;
    default:
        return prototype_isosurface_blobs;
    }
}

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
    for (const PrototypeTime& time : prototype_times(view)) {
        if (time.elements_a_side == elements_a_side && time.order == order && time.size == size) {
            return time.milliseconds;
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
                Frame frame = renderer.render(request);
                for (int i = 0; i < n_runs; ++i) {
                    frame = renderer.render(request);
                    result.milliseconds =
                        i == 0 ? frame.device_milliseconds : std::min(result.milliseconds, frame.device_milliseconds);
                    result.wall_milliseconds =
                        i == 0 ? frame.render_milliseconds : std::min(result.wall_milliseconds, frame.render_milliseconds);
                }
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
