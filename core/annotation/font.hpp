/**
 * @file font.hpp
 * Text as masks, from an outline font by FreeType.
 */
#pragma once

#include <core/annotation/mask.hpp>
#include <core/base/font_paths.hpp>

#include <memory>
#include <string>
#include <vector>

namespace elvis {

/** One face of a font file. Sizes are the em in pixels, > 0. One thread at a time may use it. */
class Font {
public:
    /** `path`: a file that FreeType reads; empty for the first of default_font_paths. Throws Error naming file and cause. */
    explicit Font(const std::string& path = {});
    ~Font();
    Font(const Font&) = delete;
    Font& operator=(const Font&) = delete;

    /** How far one line of UTF-8 text advances, kerning included, in pixels. */
    double advance(const std::string& text, double size) const;

    /**
     * One line of UTF-8 text whose baseline begins at (0, 0): the box of the mask is that of the ink. Upwards, the text is
     * turned by 90 degrees against the clock. Characters that the font lacks are drawn as its own sign for them.
     */
    Mask text(const std::string& text, double size, bool is_upwards = false) const;

    /** Height of digits above the baseline, in pixels. */
    double digit_height(double size) const;

    /** From one line's baseline to the next, in pixels. */
    double line_height(double size) const;

private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace elvis
