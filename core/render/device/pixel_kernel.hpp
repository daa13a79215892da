/**
 * @file pixel_kernel.hpp
 * Light kernels with one invocation a pixel, which the whole picture takes at once.
 */
#pragma once

#include <core/render/device/in_batches.hpp>
#include <core/render/picture/layer.hpp>
#include <core/shader/composer.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace elvis {

/** Large groups: light kernels spend much of their time on starting them. */
inline constexpr std::uint32_t pixel_group_size = 256;
/** Groups along x; more pixels go along y, where a device need not allow more than 65535: those of nearly 2^31 pixels. */
inline constexpr std::uint32_t pixel_groups_x = 128;

/** Request of shaders/NAME.comp with these buffers. */
inline KernelRequest pixel_kernel(const std::string& name, Precision precision, const BufferCounts& buffers,
                                  std::size_t push_bytes) {
    KernelRequest request;
    request.name = name;
    request.kernel = name + ".comp";
    request.precision = precision;
    request.defines = {{"CORE_GROUP_SIZE", std::to_string(pixel_group_size) + "u"}};
    request.bindings = buffer_bindings(buffers);
    request.push_constant_bytes = static_cast<std::uint32_t>(push_bytes);
    return request;
}

inline void dispatch_pixels(const ComposedKernel& kernel, const std::vector<const Buffer*>& bindings,
                            std::span<const std::byte> push_constants, std::uint32_t n_pixels) {
    constexpr std::uint32_t pixels_a_row = pixel_group_size * pixel_groups_x;
    // Groups without pixels cost as much as others: small pictures have one row, as long as it need be.
    const std::uint32_t n_groups = divided_up(n_pixels, pixel_group_size);
    kernel.dispatch(bindings, push_constants, std::min(pixel_groups_x, n_groups), divided_up(n_pixels, pixels_a_row));
}

/** Only for the layer's rows, and some around them. */
inline void dispatch_rows(const ComposedKernel& kernel, const std::vector<const Buffer*>& bindings,
                          std::span<const std::byte> push_constants, const Layer& layer) {
    constexpr std::uint64_t pixels_a_row = std::uint64_t{pixel_group_size} * pixel_groups_x;
    const auto first = static_cast<std::uint32_t>(std::uint64_t{layer.rows.first} * layer.width / pixels_a_row);
    const auto end =
        static_cast<std::uint32_t>((std::uint64_t{layer.rows.end} * layer.width + pixels_a_row - 1) / pixels_a_row);
    const std::uint64_t n_groups = (layer.n_pixels() + pixel_group_size - 1) / pixel_group_size;
    const std::uint32_t across = std::min(pixel_groups_x, static_cast<std::uint32_t>(n_groups));
    kernel.dispatch_from({0, first}, bindings, push_constants, across, end - first);
}

} // namespace elvis
