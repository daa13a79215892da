/**
 * @file part_picture.hpp
 * What one part of a volume gives to a picture: what it shows of each pixel where it shows anything.
 */
#pragma once

#include <core/render/frame.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace elvis {

/** Of a pixel in which the part's rays meet something, or leave something open. */
struct PartPixel {
    std::uint32_t pixel = 0;
    std::uint32_t flags = 0;
    /** The element's number; -1 where nothing is met, or the surface lies in no element. */
    std::int64_t element = -1;
    /** Of the depth: NaN where nothing is met. */
    double value = 0, depth = std::numeric_limits<double>::quiet_NaN();
    std::array<double, 3> normal{};
    std::array<double, 4> color{};
    /** Whether the element is the part's own, not one of its surroundings. */
    std::uint64_t is_own = 0;

    bool is_hit() const { return element >= 0; }
    /** In no element that the part knows; the surface has a colour for that (Surface::outside). */
    bool is_outside() const { return element < 0 && !std::isnan(depth); }
};

/** What a part shows of a block of pixels, which are counted in the block; of layers, one after the other. */
struct PartPixels {
    std::uint32_t part = 0;
    std::vector<PartPixel> pixels;
};

/** Flags without open lines where such a line is found. */
std::uint32_t settled_lines(std::uint32_t flags);

struct PartPicture {
    std::uint32_t part = 0;
    /** Ascending; of layers, each by itself. */
    std::vector<PartPixel> pixels;
    /** All of the part's frame that is not of pixels: counts, times, what is met, light of the volume. */
    Frame facts;

    void take_facts(Frame frame);
};

/** `is_own`: whether the element of that number is the part's. */
PartPicture part_picture(std::uint32_t part, Frame frame, const std::function<bool(std::int64_t)>& is_own);
/** Of Frame::layers: pixels of one after the other. */
PartPicture part_layers(std::uint32_t part, Frame frame, const std::function<bool(std::int64_t)>& is_own);

/** Facts to be sent, one part's after the other's; and back. Between processes of one program on machines of one kind. */
void pack_facts(const Frame& facts, std::vector<std::byte>& bytes);
std::vector<Frame> unpacked_facts(std::span<const std::byte> bytes);

} // namespace elvis
