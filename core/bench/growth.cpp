#include <core/bench/growth.hpp>

#include <core/base/memory.hpp>
#include <core/base/milliseconds.hpp>
#include <core/bench/repeated_frame.hpp>

#include <chrono>
#include <utility>

namespace elvis {

namespace {

constexpr int n_growth_runs = 3;
constexpr std::uint32_t growth_geometry_order = 1;

RuntimeVolume straight_waves(const PluginRegistry& registry, const BenchFolder& folder, std::uint32_t n, std::uint32_t order) {
    return generated_volume(registry, folder, "straight-waves-" + std::to_string(n) + "-order-" + std::to_string(order),
                            R"({"generator":1,"mesh":"waves","shape":"hexahedron","field":"waves","geometry_order":)" +
                                std::to_string(growth_geometry_order) + R"(,"elements":)" + std::to_string(n) + R"(,"order":)" +
                                std::to_string(order) + "}");
}

std::uint64_t cube(std::uint64_t number) { return number * number * number; }

std::uint64_t resident_now() {
    give_back_free_memory();
    return resident_bytes();
}

std::uint64_t difference(std::uint64_t larger, std::uint64_t smaller) { return larger > smaller ? larger - smaller : 0; }

/** With a renderer of its own, so that memory is what this picture takes. */
GrowthRow measure(const Device& device, const RuntimeVolume& volume, const FrameRequest& request, std::uint64_t before) {
    GrowthRow row;
    const std::uint64_t device_before = device.allocated_bytes();
    const auto start = std::chrono::steady_clock::now();
    Renderer renderer(device, volume, Precision::float32);
    renderer.render(request);
    row.first_milliseconds = milliseconds_since(start);
    const RepeatedFrame repeated = render_repeatedly(renderer, request, n_growth_runs);
    const FrameCounts& counts = repeated.frame.counts;
    row.milliseconds = repeated.milliseconds;
    row.wall_milliseconds = repeated.wall_milliseconds;
    row.hit_pixels = counts.hit_pixels;
    const auto pixels = static_cast<double>(counts.hit_pixels);
    row.nanoseconds_a_pixel = 1e6 * row.milliseconds / pixels;
    row.evaluations_a_pixel = static_cast<double>(counts.field_evaluations) / pixels;
    row.newton_steps_a_pixel = static_cast<double>(counts.newton_iterations) / pixels;
    row.device_bytes = difference(device.allocated_bytes(), device_before);
    row.host_bytes = difference(resident_now(), before);
    if (device.summary().type == "cpu") {
        row.host_bytes = difference(row.host_bytes, row.device_bytes);
    }
    return row;
}

} // namespace

void bench_growth(const Device& device, const PluginRegistry& registry, const BenchFolder& folder, const GrowthOptions& options,
                  const std::function<void(const GrowthRow&)>& report) {
    const std::pair<const char*, FrameRequest> pictures[] = {{"cut plane", waves_cut_plane(options.size)},
                                                             {"isosurface", waves_isosurface(options.size, 0, true)}};
    for (const std::uint32_t order : options.orders) {
        for (const std::uint32_t n : options.elements_a_side) {
            // What making the volume left behind is not counted.
            straight_waves(registry, folder, n, order);
            const std::uint64_t before = resident_now();
            const auto start = std::chrono::steady_clock::now();
            const RuntimeVolume volume = straight_waves(registry, folder, n, order);
            const double opening = milliseconds_since(start);
            for (const auto& [name, request] : pictures) {
                GrowthRow row = measure(device, volume, request, before);
                row.picture = name;
                row.n_elements = volume.n_elements();
                row.order = order;
                row.first_milliseconds += opening;
                row.n_coefficients = row.n_elements * (cube(order + 1) + 3 * cube(growth_geometry_order + 1));
                report(row);
            }
        }
    }
}

} // namespace elvis
