/**
 * @file four_pictures.hpp
 * Four pictures of any native volume, as other native renderers of high-order fields draw them: what a frame takes.
 */
#pragma once

#include <core/bench/bench.hpp>
#include <core/render/frame.hpp>
#include <core/render/renderer.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace elvis {

struct PictureRow {
    /** slice, boundary, isosurface or volume. */
    std::string name;
    std::uint32_t size = 0;
    /** The least of some frames after the first. */
    double milliseconds = 0, wall_milliseconds = 0;
    FrameCounts counts;
    /** Pixels that something is seen in. */
    std::uint64_t covered_pixels = 0;
};

struct NamedFrame {
    /** slice, boundary, isosurface or volume. */
    const char* name;
    FrameRequest request;
};

/** Those of bench_four_pictures. */
std::vector<NamedFrame> four_pictures(Renderer& renderer, std::uint32_t size);

/**
 * A slice across and the lit boundary, `size`^2 pixels; the isosurface in the middle of the first field's range, lit, and the
 * volume itself, `size / 2`^2. The eye looks from direction (1, 0.8, 0.6) and sees the bounds' sphere under 30 degrees. Colours
 * are coolwarm. The volume's density goes from 0 to that by which a hundredth of the diagonal, a hundred times in a row, leaves
 * 0.7^10 of the light. Calls `report` after each row.
 */
void bench_four_pictures(const Device& device, const PluginRegistry& registry, const std::string& volume, std::uint32_t size,
                         const std::function<void(const PictureRow&)>& report);

} // namespace elvis
