#include <core/render/device/pixel_kernel.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/render/picture/lic_pass.hpp>

#include <cmath>

namespace elvis {

namespace {

struct OwnersParameters {
    std::uint32_t n_pixels, groups_x;
};

struct ComponentParameters {
    std::uint32_t n_pixels, groups_x;
    std::uint32_t component;
};

struct DirectionsParameters {
    std::uint32_t n_pixels, groups_x, width;
    std::uint32_t is_plane;
};

struct ConvolutionParameters {
    std::uint32_t n_pixels, groups_x, width;
    std::uint32_t first_row, grain, n_steps;
    float step, contrast;
};

/** In pixels. */
constexpr double longest_step = 0.5;

/** Bytes of one core_lic_pixel. */
std::size_t lic_pixel_bytes(Precision precision) { return precision == Precision::float64 ? 24 : 12; }

} // namespace

LicPass::LicPass(const Device& device, Precision precision)
    : m_device(device), m_precision(precision),
      m_owners(device, pixel_kernel("picture/lic_owners", precision, {.storage = 2}, sizeof(OwnersParameters))),
      m_component(device, pixel_kernel("picture/lic_component", precision, {.storage = 3}, sizeof(ComponentParameters))),
      m_directions(device, pixel_kernel("picture/lic_directions", precision, {.uniform = 1, .storage = 6},
                                        sizeof(DirectionsParameters))),
      m_convolution(device, pixel_kernel("picture/lic", precision, {.storage = 3}, sizeof(ConvolutionParameters))),
      m_view(view_buffer(device, precision)), m_numbers(device, 4 * real_bytes(precision)) {}

void LicPass::begin(const Layer& layer, const Layer& values) {
    provide_buffer(m_vectors, m_device, 3 * layer.n_pixels() * real_bytes(m_precision));
    provide_buffer(m_pixels, m_device, layer.n_pixels() * lic_pixel_bytes(m_precision));
    provide_buffer(m_shades, m_device, layer.n_pixels() * real_bytes(m_precision));
    const OwnersParameters parameters{static_cast<std::uint32_t>(layer.n_pixels()), pixel_groups_x};
    dispatch_pixels(m_owners, {&layer.marks, &values.marks}, std::as_bytes(std::span(&parameters, 1)), parameters.n_pixels);
}

void LicPass::take(const Layer& layer, const Layer& values, std::uint32_t component) const {
    const ComponentParameters parameters{static_cast<std::uint32_t>(layer.n_pixels()), pixel_groups_x, component};
    dispatch_rows(m_component, {&layer.marks, &values.samples, &*m_vectors}, std::as_bytes(std::span(&parameters, 1)), layer);
}

void LicPass::convolve(const Layer& layer, const CutPlaneGeometry& view, bool is_plane, const Vectors& vectors, const Lic& lic,
                       std::uint32_t first_row) {
    write_view(m_view, m_precision, view);
    const std::array<double, 4> numbers = {vectors.offsets[0], vectors.offsets[1], vectors.offsets[2], vectors.error};
    write_reals(m_numbers, m_precision, numbers);
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    const DirectionsParameters directions{n_pixels, pixel_groups_x, layer.width, is_plane ? 1u : 0u};
    dispatch_rows(m_directions, {&m_view, &layer.samples, &layer.marks, &layer.normals, &*m_vectors, &m_numbers, &*m_pixels},
                  std::as_bytes(std::span(&directions, 1)), layer);
    const auto n_steps = static_cast<std::uint32_t>(std::ceil(lic.length / longest_step));
    const float step = static_cast<float>(n_steps > 0 ? lic.length / n_steps : 0);
    const ConvolutionParameters convolution{n_pixels,  pixel_groups_x, layer.width, first_row,
                                            lic.grain, n_steps,        step,        static_cast<float>(lic.contrast)};
    dispatch_rows(m_convolution, {&layer.marks, &*m_pixels, &*m_shades}, std::as_bytes(std::span(&convolution, 1)), layer);
}

} // namespace elvis
