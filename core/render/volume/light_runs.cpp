#include <core/render/device/pixel_kernel.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/render/volume/light_runs.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>

namespace elvis {

namespace {

struct RunParameters {
    std::uint32_t n_pixels, groups_x, width, when;
};

/** One core_run as the device writes it. */
template <class Real> struct DeviceRun {
    std::uint32_t pixel, flags;
    Real first, end, red, green, blue, transmittance, error, rounding;
};

template <class Real> void read_runs(const Buffer& from, std::size_t n, std::uint16_t n_stops, std::vector<LightRun>& runs) {
    for (const DeviceRun<Real>& run : from.read_items<DeviceRun<Real>>(n)) {
        const auto number = [](Real real) { return static_cast<double>(real); };
        runs.push_back({run.pixel, static_cast<std::uint16_t>(run.flags), n_stops, number(run.first), number(run.end),
                        number(run.red), number(run.green), number(run.blue), number(run.transmittance), number(run.error),
                        number(run.rounding)});
    }
}

std::size_t run_bytes(Precision precision) {
    return with_real(precision, []<class Real>(Real) { return sizeof(DeviceRun<Real>); });
}

} // namespace

double error_of(const LightRun& light) {
    constexpr double rounding_shown = 0.25; // As in shaders/volume/volume_light.glsl.
    return light.error + rounding_shown * std::sqrt(light.rounding);
}

void add_behind(LightRun& light, const LightRun& behind) {
    const double t = light.transmittance;
    light.red += t * behind.red;
    light.green += t * behind.green;
    light.blue += t * behind.blue;
    light.error += t * behind.error;
    light.rounding += t * t * behind.rounding;
    light.transmittance *= behind.transmittance;
    light.flags |= behind.flags;
    light.end = std::max(light.end, behind.end);
}

LightRuns::LightRuns(const Device& device, Precision precision)
    : m_device(device), m_precision(precision),
      m_kernel(device, pixel_kernel("volume/volume_runs", precision, {.uniform = 1, .storage = 4}, sizeof(RunParameters))),
      m_count(device, sizeof(std::uint32_t)) {}

void LightRuns::begin(std::uint32_t width, std::uint32_t height) {
    m_width = width;
    m_n_pixels = width * height;
    m_n_stops = 0;
    m_taken.clear();
    // Until a walk is found, a ray begins at the eye: large and negative in both precisions.
    constexpr std::uint32_t far_behind = 0xff000000u;
    provide_buffer(m_firsts, m_device, m_n_pixels * real_bytes(m_precision)).fill(far_behind);
    provide_buffer(m_runs, m_device, m_n_pixels * run_bytes(m_precision));
}

void LightRuns::take(const Buffer& view, const Buffer& states, When when) {
    const RunParameters parameters{m_n_pixels, pixel_groups_x, m_width, static_cast<std::uint32_t>(when)};
    m_count.fill(0);
    dispatch_pixels(m_kernel, {&view, &states, &*m_firsts, &*m_runs, &m_count}, std::as_bytes(std::span(&parameters, 1)),
                    m_n_pixels);
    const std::size_t n = m_count.read_items<std::uint32_t>(1)[0];
    if (n > 0) {
        with_real(m_precision, [&]<class Real>(Real) { read_runs<Real>(*m_runs, n, m_n_stops, m_taken); });
    }
    m_n_stops = static_cast<std::uint16_t>(m_n_stops + (when == When::at_stop ? 1 : 0));
}

std::vector<LightRun> LightRuns::sorted() {
    std::ranges::stable_sort(m_taken, {},
                             [](const LightRun& run) { return std::tuple(run.pixel, run.n_stops, run.first, run.end); });
    return std::exchange(m_taken, {});
}

} // namespace elvis
