#include <core/annotation/svg.hpp>
#include <core/annotation/utf8.hpp>
#include <core/base/xml_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace elvis {

namespace {

template <class... Numbers> std::string formatted(const char* format, Numbers... numbers) {
    char text[300];
    std::snprintf(text, sizeof text, format, numbers...);
    return text;
}

/** Attributes of a fill or a stroke. */
std::string svg_color(const char* attribute, const Color& color) {
    const auto level = [](double channel) { return std::lround(255 * std::clamp(channel, 0.0, 1.0)); };
    std::string text = formatted(" %s=\"#%02lx%02lx%02lx\"", attribute, level(color[0]), level(color[1]), level(color[2]));
    if (color[3] < 1) {
        text += formatted(" %s-opacity=\"%.4g\"", attribute, color[3]);
    }
    return text;
}

/** As Font writes it: a blank for what cannot be seen, and for what is not text the sign for that. XML allows neither. */
std::string readable_text(const std::string& text) {
    std::u32string characters = decode_utf8(text);
    for (char32_t& character : characters) {
        character = character < 0x20 || character == 0x7F        ? U' '
                    : character == 0xFFFE || character == 0xFFFF ? 0xFFFD
                                                                 : character;
    }
    return xml_text(encode_utf8(characters));
}

std::string svg_text(const PixelBox& box, const TextLine& line, const std::string& look) {
    const double x = box.left + line.baseline[0], y = box.top + line.baseline[1];
    std::string element =
        formatted("<text x=\"%.6g\" y=\"%.6g\" font-size=\"%.6g\" textLength=\"%.6g\"", x, y, line.size, line.advance);
    element.append(" font-family=\"'")
        .append(readable_text(line.family))
        .append("', sans-serif\" xml:space=\"preserve\"")
        .append(look);
    if (line.is_upwards) {
        element += formatted(" transform=\"rotate(-90 %.6g %.6g)\"", x, y);
    }
    return element.append(">").append(readable_text(line.text)).append("</text>\n");
}

std::string svg_polygon(const PixelBox& box, const std::vector<Point2>& points, const std::string& look) {
    std::string element = "<polygon points=\"";
    for (const Point2& point : points) {
        element += formatted("%.6g,%.6g ", box.left + point[0], box.top + point[1]);
    }
    element.back() = '"';
    return element.append(look).append("/>\n");
}

std::string svg_shape(const Mask& mask, const std::string& look) {
    if (mask.box.is_empty()) {
        return {};
    }
    if (mask.text) {
        return svg_text(mask.box, *mask.text, look);
    }
    return mask.polygon.empty() ? std::string() : svg_polygon(mask.box, mask.polygon, look);
}

PixelBox box_of(const Drawing& drawing, double halo_radius, const Frame& frame) {
    const PixelBox box = grown(drawing.box(), static_cast<int>(std::ceil(halo_radius)));
    return {std::max(box.left, 0), std::max(box.top, 0), std::min(box.right, static_cast<int>(frame.width)),
            std::min(box.bottom, static_cast<int>(frame.height))};
}

/** The first of the box's channels in a row of the picture. */
std::size_t row_begin(const Frame& frame, const PixelBox& box, int row) {
    return 4 * (static_cast<std::size_t>(row) * frame.width + static_cast<std::size_t>(box.left));
}

} // namespace

std::vector<CoveredPart> covered_by(const AnnotationPlan& plan, const Frame& frame) {
    std::vector<CoveredPart> parts;
    for (const AnnotationPlan::Item& item : plan.items) {
        CoveredPart part{box_of(item.drawing, plan.halo_radius, frame), {}};
        for (int row = part.box.top; row < part.box.bottom; ++row) {
            const double* const from = &frame.color[row_begin(frame, part.box, row)];
            part.color.insert(part.color.end(), from, from + std::ptrdiff_t{4} * std::max(0, part.box.width()));
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

void uncover(Frame& frame, const std::vector<CoveredPart>& covered) {
    for (const CoveredPart& part : covered) {
        const std::size_t n_row = 4 * static_cast<std::size_t>(std::max(0, part.box.width()));
        for (int row = part.box.top; row < part.box.bottom; ++row) {
            std::copy_n(&part.color[static_cast<std::size_t>(row - part.box.top) * n_row], n_row,
                        &frame.color[row_begin(frame, part.box, row)]);
        }
    }
}

std::string svg_elements(const AnnotationPlan& plan, const Frame& frame) {
    std::string text;
    for (const AnnotationPlan::Item& item : plan.items) {
        const Drawing::Colors colors = item.drawing.colors_on(frame, item.ink, plan.halo_radius);
        text += "<g>\n";
        if (colors.halo) {
            Color opaque = *colors.halo;
            opaque[3] = 1;
            // As one shape: where halos overlap they are no denser.
            text += formatted("<g opacity=\"%.4g\" stroke-width=\"%.6g\" stroke-linejoin=\"round\">\n", (*colors.halo)[3],
                              2 * plan.halo_radius);
            for (const Drawing::Shape& shape : item.drawing.shapes()) {
                text += shape.has_halo ? svg_shape(shape.mask, svg_color("fill", opaque) + svg_color("stroke", opaque)) : "";
            }
            text += "</g>\n";
        }
        for (const Drawing::Shape& shape : item.drawing.shapes()) {
            // Smoothed edges would let what is behind shine through between rows of colour bars.
            text += svg_shape(shape.mask, svg_color("fill", shape.color.value_or(colors.ink)) +
                                              (is_on_pixels(shape.mask) ? " shape-rendering=\"crispEdges\"" : ""));
        }
        text += "</g>\n";
    }
    return text;
}

} // namespace elvis
