/**
 * @file layer.hpp
 * What is known of each pixel of a picture, or of one surface before it is merged into the picture.
 */
#pragma once

#include <core/render/device/late_counts.hpp>
#include <core/render/frame.hpp>
#include <core/vulkan/buffer.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace elvis {

/** Bytes of one sample. */
inline std::size_t sample_bytes(Precision precision) { return precision == Precision::float64 ? 24 : 12; }

/** Bytes of one core_place. */
inline std::size_t place_bytes(Precision precision) { return precision == Precision::float64 ? 32 : 20; }

/** One core_sample as the device writes it (shaders/picture/samples.glsl). */
template <class Real> struct Sample {
    Real value, depth;
    std::uint32_t number;
};

/** Sample::number where the surface lies in no element. */
inline constexpr std::uint32_t no_number = 0xffffffffu;

/** Bits of core_mark.owner below the surface. */
inline constexpr std::uint32_t owner_bits = 6;

/** One core_mark. */
struct Mark {
    std::uint32_t owner = 0;
    std::uint32_t flags = 0;

    /** Counted from 1; 0 where nothing was drawn. */
    std::uint32_t surface() const { return owner >> owner_bits; }
};

/** Rows of pixels from the first on, and before the end. */
struct PixelRows {
    std::uint32_t first = 0, end = 0;
};

/** The buffers of a layer, one record a pixel. */
struct Layer {
    std::uint32_t width, height;
    /** In which something may be seen: passes may leave the others as they are. */
    PixelRows rows;
    Buffer samples;
    /** All zero where nothing was drawn. */
    Buffer marks;
    /** Unit, towards the viewer, three numbers a pixel. Of planes the host knows it: theirs are not written. */
    Buffer normals;
    Buffer colors;
    /** For counts that may come with the picture; null: there is none. */
    LateCounts* late = nullptr;

    Layer(const Device& device, Precision precision, std::uint32_t across, std::uint32_t down)
        : width(across), height(down), rows{0, down}, samples(device, n_pixels() * sample_bytes(precision)),
          marks(device, n_pixels() * sizeof(Mark)), normals(device, 3 * n_pixels() * real_bytes(precision)),
          colors(device, 4 * n_pixels() * real_bytes(precision)) {}

    std::uint64_t n_pixels() const { return std::uint64_t{width} * height; }
};

/** Some of the rows of a picture's tiles. */
struct TileRows {
    std::uint32_t first, end;
};

/** Where a pass draws a surface. */
struct LayerTarget {
    const Layer& layer;
    /** One real a pixel: only what is farther than this depth is wanted. Null: all that is in front of the eye. */
    const Buffer* beyond = nullptr;
    /** Else the pass may leave the layer's normals as they are. */
    bool wants_normals = true;
    /** One core_place a pixel (shaders/element/place.glsl), of passes other than of planes. Null: not wanted. */
    const Buffer* places = nullptr;
    /** Rows of pixels from which on, and before which, something is wanted. */
    std::uint32_t first_row = 0, end_row = 0xffffffffu;

    TileRows tile_rows(std::uint32_t tile_height) const {
        return {first_row / tile_height, (std::min(end_row, layer.height) + tile_height - 1) / tile_height};
    }
};

/** The component of the field that is drawn, or -1 for the length of the vector, and how many there are. */
struct ShownComponent {
    std::int32_t component = 0;
    std::uint32_t n_components = 1;
    bool is_discontinuous = false;
    /** Values that differ by no more look the same. */
    float value_tolerance = 0;

    std::uint32_t first() const { return component < 0 ? 0 : static_cast<std::uint32_t>(component); }
    std::uint32_t end() const { return component < 0 ? n_components : first() + 1; }
};

/** What the kernels of passes count first in their buffer: evaluations, steps of Newton's method, failures of it. */
inline constexpr std::size_t n_pass_counts = 3;

/** Calls `take` with the first words of a buffer as they are now: late, if the layer's picture allows it. */
inline void take_counts(const Layer& layer, const Buffer& from, std::size_t n_words, LateCounts::Take take) {
    if (layer.late != nullptr) {
        layer.late->add(from, n_words, std::move(take));
    } else {
        take(from.read_items<std::uint32_t>(n_words));
    }
}

/** `counts` lives as long as the picture is drawn. */
inline void add_pass_counts(const Layer& layer, const Buffer& from, FrameCounts& counts) {
    take_counts(layer, from, n_pass_counts, [&counts](std::span<const std::uint32_t> found) {
        counts.field_evaluations += found[0];
        counts.newton_iterations += found[1];
        counts.newton_failures += found[2];
    });
}

} // namespace elvis
