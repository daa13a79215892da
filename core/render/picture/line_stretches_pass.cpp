#include <core/render/device/pixel_kernel.hpp>
#include <core/render/device/provide_buffer.hpp>
#include <core/render/picture/line_stretches_pass.hpp>

#include <vector>

namespace elvis {

namespace {

struct StretchParameters {
    std::uint32_t n_pixels, groups_x, width, n_isovalues;
};

} // namespace

LineStretchesPass::LineStretchesPass(const Device& device, Precision precision)
    : m_device(device), m_precision(precision),
      m_kernel(device, pixel_kernel("picture/line_stretches", precision, {.storage = 4}, sizeof(StretchParameters))) {}

const Buffer& LineStretchesPass::draw(const Layer& layer, std::span<const double> isovalues) {
    const Buffer& stretches = provide_buffer(m_stretches, m_device, 2 * layer.n_pixels() * sizeof(std::uint32_t));
    stretches.fill(0);
    std::vector<double> numbers(isovalues.begin(), isovalues.end());
    const StretchParameters parameters{static_cast<std::uint32_t>(layer.n_pixels()), pixel_groups_x, layer.width,
                                       static_cast<std::uint32_t>(numbers.size())};
    numbers.push_back(0); // No buffer is empty.
    const Buffer values(m_device, numbers.size() * real_bytes(m_precision));
    write_reals(values, m_precision, numbers);
    dispatch_rows(m_kernel, {&layer.samples, &layer.marks, &values, &stretches}, std::as_bytes(std::span(&parameters, 1)),
                  layer);
    return stretches;
}

} // namespace elvis
