#include <core/annotation/drawing.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

struct Backdrop {
    double mean = 1;
    /** Share of pixels on which ink of a given brightness would be hard to see. */
    double near_black = 0, near_white = 0;
};

Backdrop backdrop(const Frame& frame, const PixelBox& box) {
    // Text is read easily from a contrast of about 0.4 in luma on.
    constexpr double contrast = 0.4;
    const int width = static_cast<int>(frame.width), height = static_cast<int>(frame.height);
    const PixelBox inside = {std::max(box.left, 0), std::max(box.top, 0), std::min(box.right, width),
                             std::min(box.bottom, height)};
    Backdrop result;
    double sum = 0, n = 0, dark = 0, bright = 0;
    for (int row = inside.top; row < inside.bottom; ++row) {
        for (int column = inside.left; column < inside.right; ++column) {
            const std::size_t at = static_cast<std::size_t>(row) * frame.width + static_cast<std::size_t>(column);
            const double value =
                brightness({frame.color[4 * at], frame.color[4 * at + 1], frame.color[4 * at + 2], frame.color[4 * at + 3]});
            sum += value;
            n += 1;
            dark += value < contrast ? 1 : 0;
            bright += value > 1 - contrast ? 1 : 0;
        }
    }
    if (n > 0) {
        result = {sum / n, dark / n, bright / n};
    }
    return result;
}

} // namespace

double brightness(const Color& color) {
    const double alpha = std::clamp(color[3], 0.0, 1.0);
    const double luma = 0.299 * color[0] + 0.587 * color[1] + 0.114 * color[2];
    return alpha * std::clamp(luma, 0.0, 1.0) + (1 - alpha);
}

void blend(Frame& frame, const Mask& mask, const Color& color) {
    const int width = static_cast<int>(frame.width), height = static_cast<int>(frame.height);
    const auto stride = static_cast<std::size_t>(mask.box.width());
    for (int row = std::max(mask.box.top, 0); row < std::min(mask.box.bottom, height); ++row) {
        for (int column = std::max(mask.box.left, 0); column < std::min(mask.box.right, width); ++column) {
            const double coverage = static_cast<double>(mask.coverage[static_cast<std::size_t>(row - mask.box.top) * stride +
                                                                      static_cast<std::size_t>(column - mask.box.left)]);
            const double alpha = color[3] * coverage;
            if (alpha <= 0) {
                continue;
            }
            double* pixel = &frame.color[4 * (static_cast<std::size_t>(row) * frame.width + static_cast<std::size_t>(column))];
            // "Over" of Porter and Duff, for colours that are not multiplied by their alpha.
            const double behind = (1 - alpha) * pixel[3];
            const double result = alpha + behind;
            for (std::size_t channel = 0; channel < 3; ++channel) {
                pixel[channel] = alpha >= 1 ? color[channel] : (alpha * color[channel] + behind * pixel[channel]) / result;
            }
            pixel[3] = alpha >= 1 ? 1 : result;
        }
    }
}

Mask text_at(const Font& font, const std::string& text, double size, int x, int y) {
    Mask mask = font.text(text, size);
    mask.box = moved(mask.box, x, y);
    return mask;
}

void Drawing::add(Mask mask, bool has_halo) {
    m_box = united(m_box, mask.box);
    m_shapes.push_back({std::move(mask), std::nullopt, has_halo});
}

void Drawing::add(Mask mask, const Color& color, bool has_halo) {
    m_box = united(m_box, mask.box);
    m_shapes.push_back({std::move(mask), color, has_halo});
}

void Drawing::add(Drawing drawing) {
    m_box = united(m_box, drawing.m_box);
    std::move(drawing.m_shapes.begin(), drawing.m_shapes.end(), std::back_inserter(m_shapes));
}

void Drawing::move(int right, int down) {
    m_box = moved(m_box, right, down);
    for (Shape& shape : m_shapes) {
        shape.mask.box = moved(shape.mask.box, right, down);
    }
}

Drawing::Colors Drawing::colors_on(const Frame& frame, const std::optional<Color>& ink, double halo_radius) const {
    const Backdrop behind = backdrop(frame, grown(m_box, static_cast<int>(std::ceil(halo_radius))));
    Colors colors{ink.value_or(behind.mean > 0.5 ? Color{0, 0, 0, 1} : Color{1, 1, 1, 1}), std::nullopt};
    const bool is_dark = brightness(colors.ink) < 0.5;
    // A pixel here and there does no harm.
    constexpr double harmless = 0.005, opacity = 0.8;
    if ((is_dark ? behind.near_black : behind.near_white) > harmless) {
        colors.halo = is_dark ? Color{1, 1, 1, opacity} : Color{0, 0, 0, opacity};
    }
    return colors;
}

void Drawing::paint(Frame& frame, const std::optional<Color>& ink, double halo_radius) const {
    const Colors colors = colors_on(frame, ink, halo_radius);
    if (colors.halo) {
        Mask halo = empty_mask(grown(m_box, static_cast<int>(std::ceil(halo_radius))));
        for (const Shape& shape : m_shapes) {
            if (shape.has_halo) {
                unite(halo, grown_mask(shape.mask, halo_radius));
            }
        }
        blend(frame, halo, *colors.halo);
    }
    for (const Shape& shape : m_shapes) {
        blend(frame, shape.mask, shape.color.value_or(colors.ink));
    }
}

} // namespace elvis
