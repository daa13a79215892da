/**
 * @file drawing.hpp
 * An item of annotation: shapes that are made first, then placed, then painted in colours that stand out where they lie.
 */
#pragma once

#include <core/annotation/font.hpp>
#include <core/annotation/mask.hpp>
#include <core/render/frame.hpp>

#include <optional>
#include <string>
#include <vector>

namespace elvis {

class Drawing {
public:
    /** In the colour of the ink: black or white. `has_halo`: gets one where the picture behind is not of one brightness. */
    void add(Mask mask, bool has_halo = true);
    /** In a colour of its own. */
    void add(Mask mask, const Color& color, bool has_halo = false);
    void add(Drawing drawing);

    /** All that is painted, halos apart. */
    const PixelBox& box() const { return m_box; }
    bool is_empty() const { return m_shapes.empty(); }

    void move(int right, int down);

    struct Shape {
        Mask mask;
        /** Of its own; else it has the ink's. */
        std::optional<Color> color;
        bool has_halo = false;
    };
    /** In the order in which they are painted. */
    const std::vector<Shape>& shapes() const { return m_shapes; }

    struct Colors {
        Color ink{};
        /** Below all that has a halo. */
        std::optional<Color> halo;
    };
    /** What paint() paints with on this picture. */
    Colors colors_on(const Frame& frame, const std::optional<Color>& ink, double halo_radius) const;

    /**
     * Blends the shapes over the picture in the order in which they were added. Without `ink` it is black or white, whichever
     * stands out more against what is under the box; where a part of that is too near to the ink, ink gets a halo of
     * `halo_radius` pixels of the opposite brightness.
     */
    void paint(Frame& frame, const std::optional<Color>& ink, double halo_radius) const;

private:
    std::vector<Shape> m_shapes;
    PixelBox m_box;
};

/** Brightness of a colour over white paper, from 0 to 1: the luma of ITU-R BT.601, made for display values. */
double brightness(const Color& color);

/** Blends a colour over the pixels that a mask covers; what lies outside the picture is left out. Display values, no gamma. */
void blend(Frame& frame, const Mask& mask, const Color& color);

/** One line of text with its baseline beginning at (x, y). */
Mask text_at(const Font& font, const std::string& text, double size, int x, int y);

} // namespace elvis
