#include <core/render/device/pixel_kernel.hpp>
#include <core/render/picture/condition_pass.hpp>
#include <core/vulkan/real_array.hpp>

#include <array>

namespace elvis {

namespace {

struct ConditionParameters {
    std::uint32_t n_pixels, groups_x, width;
    std::uint32_t is_above, takes_equal;
};

} // namespace

ConditionPass::ConditionPass(const Device& device, Precision precision)
    : m_precision(precision),
      m_kernel(device, pixel_kernel("picture/condition", precision, {.storage = 5}, sizeof(ConditionParameters))),
      m_limit(device, 2 * real_bytes(precision)) {}

void ConditionPass::judge(const Layer& layer, const Layer& values, const ConditionLimit& limit) const {
    const std::array<double, 2> numbers = {limit.value, limit.error};
    write_reals(m_limit, m_precision, numbers);
    const ConditionParameters parameters{static_cast<std::uint32_t>(layer.n_pixels()), pixel_groups_x, layer.width,
                                         limit.is_above ? 1u : 0u, limit.takes_equal ? 1u : 0u};
    dispatch_rows(m_kernel, {&layer.samples, &layer.marks, &values.samples, &m_limit, &values.marks},
                  std::as_bytes(std::span(&parameters, 1)), layer);
}

} // namespace elvis
