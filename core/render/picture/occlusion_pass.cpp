#include <core/render/device/pixel_kernel.hpp>
#include <core/render/picture/occlusion_pass.hpp>

namespace elvis {

namespace {

struct OcclusionParameters {
    std::uint32_t n_pixels, groups_x, step;
};

} // namespace

OcclusionPass::OcclusionPass(const Device& device, Precision precision)
    : m_kernel(device, pixel_kernel("picture/occlude", precision, {.storage = 4}, sizeof(OcclusionParameters))),
      m_counts(device, sizeof(std::uint32_t)) {}

void OcclusionPass::run(const Layer& layer, const Buffer& depths, Step step) const {
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    const OcclusionParameters parameters{n_pixels, pixel_groups_x, static_cast<std::uint32_t>(step)};
    dispatch_rows(m_kernel, {&layer.samples, &layer.marks, &depths, &m_counts}, std::as_bytes(std::span(&parameters, 1)),
                  layer);
}

void OcclusionPass::begin(const Layer& layer, const Buffer& depths) const { run(layer, depths, Step::put); }

std::uint32_t OcclusionPass::counted(const Layer& layer, const Buffer& depths, Step step) const {
    m_counts.fill(0);
    run(layer, depths, step);
    return m_counts.read_items<std::uint32_t>(1)[0];
}

std::uint32_t OcclusionPass::end(const Layer& layer, const Buffer& depths) const { return counted(layer, depths, Step::take); }

std::uint32_t OcclusionPass::hide(const Layer& layer, const Buffer& depths) const { return counted(layer, depths, Step::hide); }

} // namespace elvis
