#include <core/render/device/pixel_kernel.hpp>
#include <core/render/picture/flags_pass.hpp>

#include <bit>
#include <string>

namespace elvis {

namespace {

struct FlagsParameters {
    std::uint32_t n_pixels, groups_x;
};

/** Pixels of an invocation. */
constexpr std::uint32_t pixels_each = 8;

/** Of the kernel's counts: one for each flag, and pixels that show a surface. */
constexpr std::size_t n_flags = 16, hits = n_flags, n_counts = n_flags + 1;

KernelRequest settling_kernel(Precision precision) {
    KernelRequest request = pixel_kernel("picture/settle_flags", precision, {.storage = 3}, sizeof(FlagsParameters));
    request.defines.emplace_back("CORE_PIXELS_EACH", std::to_string(pixels_each) + "u");
    return request;
}

} // namespace

FlagsPass::FlagsPass(const Device& device, Precision precision)
    : m_kernel(device, settling_kernel(precision)), m_counts(device, n_counts * sizeof(std::uint32_t)) {}

void FlagsPass::settle(const Layer& layer) const {
    m_counts.fill(0);
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    const FlagsParameters parameters{n_pixels, pixel_groups_x};
    dispatch_pixels(m_kernel, {&layer.marks, &m_counts, &layer.marks}, std::as_bytes(std::span(&parameters, 1)),
                    divided_up(n_pixels, pixels_each * pixel_group_size) * pixel_group_size);
}

void FlagsPass::add(std::span<const std::uint32_t> found, FrameCounts& counts) {
    const auto with = [&](std::uint32_t flag) { return found[static_cast<std::size_t>(std::countr_zero(flag))]; };
    counts.hit_pixels += found[hits];
    counts.undecided_pixels += with(pixel_flag::undecided);
    counts.overlap_pixels += with(pixel_flag::overlap);
    counts.nan_pixels += with(pixel_flag::nan);
    counts.work_limit_pixels += with(pixel_flag::work_limit);
    counts.estimated_pixels += with(pixel_flag::estimated);
    counts.isosurface_pixels += with(pixel_flag::isosurface);
    counts.undecided_isosurface_pixels += with(pixel_flag::isosurface_undecided);
    counts.inexact_volume_pixels += with(pixel_flag::volume_tolerance);
    counts.contour_pixels += with(pixel_flag::contour);
    counts.undecided_contour_pixels += with(pixel_flag::contour_undecided);
    counts.mesh_line_pixels += with(pixel_flag::mesh_line);
    counts.undecided_mesh_line_pixels += with(pixel_flag::mesh_line_undecided);
}

} // namespace elvis
