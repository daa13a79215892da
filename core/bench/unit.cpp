#include <core/bench/bench.hpp>

#include <core/render/device/device_time.hpp>
#include <core/shader/composer.hpp>
#include <core/volume/device_volume.hpp>

#include <algorithm>
#include <array>

namespace elvis {

namespace {

constexpr std::uint32_t unit_group_size = 8;
constexpr std::uint32_t n_groups = 4096;
constexpr std::uint32_t values_an_invocation = 16;
constexpr int n_unit_runs = 7;

struct Parameters {
    std::uint32_t n_elements;
    std::uint32_t n_values;
};

} // namespace

UnitResult bench_unit(const Device& device, const PluginRegistry& registry, const BenchFolder& folder) {
    const RuntimeVolume volume = waves_volume(registry, folder, 16, 6);
    DeviceVolume data(device, volume, Precision::float32, nullptr);
    data.select(0, 0, {0.0});
    KernelRequest request;
    request.name = "bench_unit";
    request.kernel = "bench/bench_unit.comp";
    request.instances = {data.instance(0)};
    request.bindings = {{0, BindingType::storage_buffer}};
    request.push_constant_bytes = sizeof(Parameters);
    const ComposedKernel kernel(device, request);
    const Buffer output(device, n_groups * unit_group_size * sizeof(float));
    const std::array<const Buffer*, 1> bindings = {&output};

    // The difference of two lengths leaves out what a dispatch and the loop cost.
    const auto run = [&](std::uint32_t n_values) {
        const Parameters parameters{static_cast<std::uint32_t>(volume.n_elements()), n_values};
        double least = 0;
        for (int i = 0; i < n_unit_runs; ++i) {
            const DeviceTimer timer(device);
            kernel.dispatch(bindings, std::as_bytes(std::span(&parameters, 1)), n_groups);
            const double time = timer.milliseconds() * timer.n_processors();
            least = i == 0 ? time : std::min(least, time);
        }
        return least;
    };
    run(1);
    const double difference = run(1 + values_an_invocation) - run(1);
    const std::uint64_t n_values = std::uint64_t{n_groups} * values_an_invocation;
    return {1e6 * difference / static_cast<double>(n_values), n_values * unit_group_size};
}

} // namespace elvis
