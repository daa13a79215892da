/**
 * @file mask.hpp
 * Antialiased shapes: how much of each pixel they cover. Positions are in pixels, y downwards, pixel (0, 0) covers [0, 1]².
 */
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace elvis {

using Point2 = std::array<double, 2>;

/** Whole pixels; right and bottom are not part of it. Empty where right <= left. */
struct PixelBox {
    int left = 0, top = 0, right = 0, bottom = 0;

    int width() const { return right - left; }
    int height() const { return bottom - top; }
    bool is_empty() const { return right <= left || bottom <= top; }
    bool meets(const PixelBox& other) const {
        return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
    }
    bool contains(const PixelBox& other) const {
        return left <= other.left && top <= other.top && right >= other.right && bottom >= other.bottom;
    }
};

/** The least box around two; an empty one counts for nothing. */
PixelBox united(const PixelBox& a, const PixelBox& b);

PixelBox moved(const PixelBox& box, int right, int down);

/** On each side. */
PixelBox grown(const PixelBox& box, int by);

/** The outline of a glyph in ems, y upwards, filled by the non-zero rule; and how far it advances. */
struct GlyphOutline {
    /** Begins a contour at points[2], which ends where it began; goes straight there; or by a cubic Bezier curve. */
    struct Step {
        enum class Kind { begin, line, curve } kind = Kind::begin;
        std::array<Point2, 3> points{};
    };
    std::vector<Step> steps;
    double advance = 0;
};

struct PlacedGlyph {
    char32_t character = 0;
    /** Of its origin on the baseline, in pixels from where that begins. */
    double x = 0;
    /** The same for all places of a glyph. */
    std::shared_ptr<const GlyphOutline> outline;
};

/** One line of text. */
struct TextLine {
    std::string text, family;
    /** Of the em, and how far the text advances, in pixels. */
    double size = 0, advance = 0;
    /** Turned by 90 degrees against the clock. */
    bool is_upwards = false;
    /** Where the baseline begins, from the upper left corner of the mask's box. */
    Point2 baseline{};
    std::vector<PlacedGlyph> glyphs{};
};

/** Coverage of the pixels of a box, from 0 to 1, top row first; and what it is of, for files that hold shapes. */
struct Mask {
    PixelBox box;
    std::vector<float> coverage;
    /** From the upper left corner of the box; empty for text. */
    std::vector<Point2> polygon{};
    /** Null for polygons. */
    std::shared_ptr<const TextLine> text{};
};

Mask empty_mask(const PixelBox& box);

/** A rectangle on whole pixels, as rows of colour bars are. */
bool is_on_pixels(const Mask& mask);

/** Each pixel the larger of both; the box of `onto` stays. */
void unite(Mask& onto, const Mask& other);

/**
 * The area that a polygon without self-intersection covers of every pixel, exact up to rounding; either orientation. Fewer
 * than three points cover nothing.
 */
Mask polygon_mask(std::span<const Point2> points);

/** The mask and what lies within `radius` pixels around it: what a halo covers. */
Mask grown_mask(const Mask& mask, double radius);

} // namespace elvis
