/**
 * @file samples.hpp
 * What passes draw into: one core_sample and one core_mark a pixel (shaders/library/samples.glsl).
 */
#pragma once

#include <core/vulkan/buffer.hpp>

#include <cstdint>

namespace elvis {

/** Bytes of one sample. */
inline std::size_t sample_bytes(Precision precision) { return precision == Precision::float64 ? 24 : 12; }

/** One core_mark. */
struct Mark {
    std::uint32_t owner = 0;
    std::uint32_t flags = 0;

    /** Counted from 1; 0 where nothing was drawn. */
    std::uint32_t surface() const { return owner >> 4u; }
};

struct SampleTarget {
    const Buffer& samples;
    /** All zero before the first pass. */
    const Buffer& marks;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/** The component of the field that is drawn, or -1 for the length of the vector, and how many there are. */
struct ShownComponent {
    std::int32_t component = 0;
    std::uint32_t n_components = 1;
    bool is_discontinuous = false;

    std::uint32_t first() const { return component < 0 ? 0 : static_cast<std::uint32_t>(component); }
    std::uint32_t end() const { return component < 0 ? n_components : first() + 1; }
};

/** Numbers that the passes' kernels add to, as they lie in their buffer. */
inline constexpr std::size_t n_pass_counts = 3;

} // namespace elvis
