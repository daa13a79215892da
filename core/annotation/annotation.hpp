/**
 * @file annotation.hpp
 * Writing on a finished picture: colour bars, axes, title, texts.
 */
#pragma once

#include <core/render/frame.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

/** What a colour map means: one bar at a side of the picture. */
struct ColorBar {
    ColorTable colors;
    /** Written along the bar, with the unit in brackets; may be empty. */
    std::string name;
    std::string unit;
    /** Whether values below and above the table's points, and such as are not numbers, occur: their colours are then shown. */
    bool has_below = false, has_above = false, has_nan = false;
};

/** Text at a place of its own; lines are separated by '\n'. */
struct AnnotationText {
    std::string text;
    /** Fractions of width and height, from the upper left corner. The text is moved as little as it takes to be inside. */
    std::array<double, 2> position{};
    /** Which point of the text lies there, as a fraction of its box: {0, 0} the upper left corner, {0.5, 0.5} the middle. */
    std::array<double, 2> anchor{};
    /** Em, as a fraction of the picture's shorter side; that of the request if left out. */
    std::optional<double> size;
    std::optional<Color> color;
};

/** Lengths are fractions of the picture's shorter side, so that a picture drawn larger looks the same. */
struct AnnotationRequest {
    std::string title;
    /** From the side inwards. */
    std::vector<ColorBar> color_bars;
    /** The directions of x, y and z as this camera sees them in the middle of the picture. */
    std::optional<Camera> axes;
    std::vector<AnnotationText> texts;

    /** A file that FreeType reads; empty for DejaVu Sans where distributions keep it. */
    std::string font;
    /** Text and lines; black or white against what is behind if left out. */
    std::optional<Color> color;
    /** Em; not less than least_text_pixels. */
    double text_size = 0.026;
    double least_text_pixels = 10;
    /** Times the text's size. */
    double title_scale = 1.4;
    /** Bars stand at the right side, or at the left. */
    bool bars_at_left = false;
    double bar_length = 0.6;
    double bar_width = 0.028;
    /** Length of an axis that lies in the picture's plane. */
    double axes_size = 0.075;
};

/** Colour of a value, as the picture's own: piecewise linear between points, the colours for below, above and NaN elsewhere. */
Color table_color(const ColorTable& table, double value);

/**
 * Writes onto frame.color, with display values and no gamma, and touches nothing else. Texts with places of their own come
 * first, then the title, the bars and the axes, each where it overlaps nothing. Returns the names of those that found no room,
 * as "color bar of pressure": they are left out. Throws Error where there is no font. Draws nothing, and needs no font, if
 * nothing is asked for.
 */
std::vector<std::string> annotate(Frame& frame, const AnnotationRequest& request);

} // namespace elvis
