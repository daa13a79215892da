/**
 * @file items.hpp
 * The items of annotation, each made around the origin; annotation.cpp gives them their places.
 */
#pragma once

#include <core/annotation/annotation.hpp>
#include <core/annotation/drawing.hpp>

namespace elvis {

/** Sizes in pixels. */
struct ItemStyle {
    double text = 20;
    /** Of lines; a whole number, so that they are crisp. */
    int line = 1;
    int bar_length = 400;
    int bar_width = 20;
    double axes = 50;
};

/**
 * Upright, low values below; the upper left pixel of its colours is (0, 0), and they are bar_width times bar_length pixels that
 * hold the colours of the values in the middles of their rows. Right of it ticks with their numbers and, upwards, name and
 * unit.
 */
Drawing color_bar(const Font& font, const ColorBar& bar, const ItemStyle& style);

/** Three arrows from (0, 0) along the axes as they are projected in the middle of the picture, the nearest in front. */
Drawing axes_triad(const Font& font, const Camera& camera, const ItemStyle& style);

/** Lines one below the other; `align` is 0 for the left, 0.5 for the middle, 1 for the right. */
Drawing text_block(const Font& font, const std::string& text, double size, double align);

} // namespace elvis
