#include <core/bench/volume/volume.hpp>

#include <core/bench/repeated_frame.hpp>

#include <core/base/error.hpp>
#include <core/render/renderer.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis {

namespace {

constexpr int n_volume_runs = 3;
/** World length of a step. */
constexpr double step_length = 3.8 / 256;

constexpr double range_end = 1.5;
constexpr std::array<Integrator, 5> integrators{Integrator::riemann, Integrator::trapezoid, Integrator::categories,
                                                Integrator::adaptive_trapezoid, Integrator::exact};
constexpr std::array<BenchTransfer, 3> transfers{BenchTransfer::prototype, BenchTransfer::peaks, BenchTransfer::ramp};

} // namespace

const char* name_of(BenchTransfer transfer) {
    switch (transfer) {
    case BenchTransfer::prototype:
        return "prototype";
    case BenchTransfer::peaks:
        return "peaks";
    default:
        return "ramp";
    }
}

TransferFunction bench_transfer(BenchTransfer transfer) {
    TransferFunction result;
    result.color = {{-range_end, {0.2, 0.3, 0.9}}, {0, {0.9, 0.9, 0.8}}, {range_end, {0.8, 0.1, 0.1}}};
    switch (transfer) {
    case BenchTransfer::prototype: {
        constexpr int n_points = 64;
        for (int i = 0; i < n_points; ++i) {
            const double value = range_end * (2.0 * i / (n_points - 1) - 1);
            const double density =
                3 * std::exp(-8 * (value - 1) * (value - 1)) + 3 * std::exp(-8 * (value + 1) * (value + 1)) + 0.3;
            result.density.push_back({value, density});
        }
        break;
    }
    case BenchTransfer::peaks:
        // The field changes by about 3 a length: a ray straight through a peak loses a quarter of its light.
        for (const double middle : {-0.9, 0.1, 0.9}) {
            constexpr double half_width = 0.005 * 2 * range_end;
            result.density.push_back({middle - half_width, 0});
            result.density.push_back({middle, 60});
            result.density.push_back({middle + half_width, 0});
        }
        break;
    case BenchTransfer::ramp:
        result.density = {{-range_end, 0}, {range_end, 3}};
        result.color = {{-range_end, {0.2, 0.3, 0.9}}, {range_end, {0.8, 0.1, 0.1}}};
        break;
    }
    return result;
}

const char* name_of(Integrator integrator) {
    switch (integrator) {
    case Integrator::riemann:
        return "riemann";
    case Integrator::trapezoid:
        return "trapezoid";
    case Integrator::categories:
        return "categories";
    case Integrator::adaptive_trapezoid:
        return "adaptive-trapezoid";
    default:
        return "exact";
    }
}

Integrator integrator_of(const std::string& name) {
    std::string all;
    for (const Integrator integrator : integrators) {
        if (name == name_of(integrator)) {
            return integrator;
        }
        all += std::string(all.empty() ? "" : ", ") + name_of(integrator);
    }
    throw Error(name, "is no integrator of volume rendering; there are " + all);
}

FrameRequest waves_volume_picture(std::uint32_t size, BenchTransfer transfer, Integrator integrator) {
    FrameRequest request = waves_cut_plane(size);
    request.surfaces.clear();
    VolumeRendering& volume = request.volume.emplace();
    volume.transfer = bench_transfer(transfer);
    volume.integrator = integrator;
    volume.step = step_length;
    return request;
}

void bench_volume(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                  const std::vector<Integrator>& wanted, const std::vector<std::uint32_t>& elements_a_side,
                  const std::vector<std::uint32_t>& orders, const std::vector<std::uint32_t>& sizes,
                  const std::function<void(const VolumeResult&)>& report) {
    for (const std::uint32_t n : elements_a_side) {
        for (const std::uint32_t order : orders) {
            const RuntimeVolume volume = waves_volume(registry, folder, n, order);
            Renderer renderer(device, volume, Precision::float32);
            for (const std::uint32_t size : sizes) {
                for (const Integrator integrator : wanted) {
                    // The first transfer function colours all pixels whose rays meet the volume.
                    std::uint64_t n_pixels = 1;
                    for (const BenchTransfer transfer : transfers) {
                        const FrameRequest request = waves_volume_picture(size, transfer, integrator);
                        VolumeResult result;
                        result.transfer = transfer;
                        result.integrator = integrator;
                        result.elements_a_side = n;
                        result.order = order;
                        result.size = size;
                        const RepeatedFrame repeated = render_repeatedly(renderer, request, n_volume_runs);
                        const Frame& frame = repeated.frame;
                        result.milliseconds = repeated.milliseconds;
                        result.wall_milliseconds = repeated.wall_milliseconds;
                        n_pixels = std::max(n_pixels, frame.counts.volume_pixels);
                        const auto a_pixel = [n_pixels](std::uint64_t count) {
                            return static_cast<double>(count) / static_cast<double>(n_pixels);
                        };
                        result.evaluations_a_pixel = a_pixel(frame.counts.field_evaluations);
                        result.mappings_a_pixel = a_pixel(frame.counts.mapping_evaluations);
                        result.segments_a_pixel = a_pixel(frame.counts.volume_segments);
                        result.empty_segments_a_pixel = a_pixel(frame.counts.empty_segments);
                        result.steps_a_pixel = a_pixel(frame.counts.volume_steps);
                        result.breakpoints_a_pixel = a_pixel(frame.counts.volume_breakpoints);
                        result.inexact_share = a_pixel(frame.counts.inexact_volume_pixels);
                        report(result);
                    }
                }
            }
        }
    }
}

} // namespace elvis
