/**
 * @file pixel_flags.hpp
 * The bits of Frame::flags with names and meanings, as files of buffers and their page tell them.
 */
#pragma once

#include <cstdint>
#include <span>

namespace elvis {

struct PixelFlag {
    std::uint32_t bit;
    const char* name;
    const char* meaning;
};

/** All bits, ascending. */
std::span<const PixelFlag> pixel_flags();

} // namespace elvis
