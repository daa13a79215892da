#include <core/render/device/pixel_kernel.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/render/picture/screen_pass.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace elvis {

namespace {

constexpr std::size_t n_channels = 4, n_levels = 256;
/** Behind what is not opaque. */
constexpr double grey = 0.5;

struct ScreenParameters {
    std::uint32_t n_pixels, groups_x;
    float grey;
};

double clamped(double value) { return std::min(1.0, value > 0 ? value : 0.0); }

/** The least number of the precision that has at least this level. */
template <class Real> Real least_of(std::size_t level) {
    const auto is_there = [&](Real number) { return screen_level(static_cast<double>(number)) >= level; };
    Real number = static_cast<Real>((static_cast<double>(level) - 0.5) / 255);
    while (!is_there(number)) {
        number = std::nextafter(number, Real(2));
    }
    for (Real below = number; is_there(below); below = std::nextafter(below, Real(-1))) {
        number = below;
    }
    return number;
}

std::vector<double> least_numbers(Precision precision) {
    std::vector<double> least;
    for (std::size_t level = 1; level < n_levels; ++level) {
        with_real(precision, [&]<class Real>(Real) { least.push_back(static_cast<double>(least_of<Real>(level))); });
    }
    least.push_back(2);
    return least;
}

} // namespace

std::uint8_t screen_level(double channel) {
    // std::lround(255 * value), in a form that processors do many of at once.
    const double scaled = 255 * clamped(channel);
    const int whole = static_cast<int>(scaled);
    return static_cast<std::uint8_t>(whole + (scaled - whole >= 0.5 ? 1 : 0));
}

std::array<std::uint8_t, 4> on_screen(const Color& color) {
    std::array<std::uint8_t, 4> rgba{0, 0, 0, 255};
    const double alpha = clamped(color[3]);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        rgba[channel] = screen_level(alpha < 1 ? alpha * clamped(color[channel]) + (1 - alpha) * grey : color[channel]);
    }
    return rgba;
}

ScreenPass::ScreenPass(const Device& device, Precision precision)
    : m_device(device), m_kernel(device, pixel_kernel("picture/screen", precision, {.storage = 3}, sizeof(ScreenParameters))),
      m_least(device, n_levels * real_bytes(precision)) {
    write_reals(m_least, precision, least_numbers(precision));
}

const Buffer& ScreenPass::draw(const Layer& layer) {
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    const Buffer& pixels = provide_buffer(m_pixels, m_device, n_channels * layer.n_pixels());
    const ScreenParameters parameters{n_pixels, pixel_groups_x, static_cast<float>(grey)};
    dispatch_pixels(m_kernel, {&layer.colors, &m_least, &pixels}, std::as_bytes(std::span(&parameters, 1)), n_pixels);
    return pixels;
}

} // namespace elvis
