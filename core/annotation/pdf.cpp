#include <core/annotation/pdf.hpp>
#include <core/annotation/pdf_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

namespace elvis {

namespace {

using Shapes = std::span<const Drawing::Shape>;

unsigned level_in_pdf(double channel) { return static_cast<unsigned>(std::lround(255 * std::clamp(channel, 0.0, 1.0))); }

/** `operation`: rg of fills, RG of strokes. The levels of 8 bits, as pictures and SVG have them. */
std::string pdf_color(const Color& color, const char* operation) {
    std::string text;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        text += pdf_numbers({level_in_pdf(color[channel]) / 255.0});
    }
    return text.append(operation).append("\n");
}

std::string pdf_path(const Mask& mask) {
    const Point2 corner{static_cast<double>(mask.box.left), static_cast<double>(mask.box.top)};
    if (mask.text) {
        return pdf_outlines(*mask.text, {corner[0] + mask.text->baseline[0], corner[1] + mask.text->baseline[1]});
    }
    std::string text;
    for (std::size_t i = 0; i < mask.polygon.size(); ++i) {
        text += pdf_numbers({corner[0] + mask.polygon[i][0], corner[1] + mask.polygon[i][1]}) + (i == 0 ? "m " : "l ");
    }
    return text + (mask.polygon.empty() ? "" : "h ");
}

bool is_row(const Drawing::Shape& shape) {
    return shape.color && (*shape.color)[3] >= 1 && shape.mask.box.height() == 1 && is_on_pixels(shape.mask);
}

/** Rows of one colour each, one below the other, as in colour bars: the first of them. */
Shapes rows_at(Shapes shapes) {
    std::size_t n = 0;
    while (n < shapes.size() && is_row(shapes[n])) {
        const PixelBox &first = shapes[0].mask.box, &here = shapes[n].mask.box;
        if (here.left != first.left || here.right != first.right || here.top != first.top + static_cast<int>(n)) {
            break;
        }
        ++n;
    }
    return shapes.first(n);
}

/** As an image: between shapes that touch, readers that smooth edges let shine through what is behind. */
std::string pdf_rows(Shapes rows) {
    const PixelBox& box = rows[0].mask.box;
    const auto n = static_cast<double>(rows.size());
    std::string text = std::string("q ") + pdf_numbers({double(box.width()), 0, 0, -n, double(box.left), box.top + n});
    text += std::string("cm\nBI /W 1 /H ") + std::to_string(rows.size()) + " /CS /RGB /BPC 8 /F /AHx ID\n";
    constexpr char digits[] = "0123456789ABCDEF";
    for (const Drawing::Shape& row : rows) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const unsigned level = level_in_pdf((*row.color)[channel]);
            text += {digits[level >> 4], digits[level & 15u]};
        }
    }
    return text + ">\nEI Q\n";
}

} // namespace

PdfDrawing pdf_drawing(const AnnotationPlan& plan, const Frame& frame, PdfFile& file) {
    PdfDrawing result;
    PdfFonts fonts;
    std::string opacities;
    const auto set_opacity = [&](double opacity) {
        const std::string name = std::string("/A") + std::to_string(std::lround(1000 * opacity));
        if (opacities.find(name + " ") == std::string::npos) {
            opacities += name + " << /ca " + pdf_numbers({opacity}) + ">> ";
        }
        return name + " gs ";
    };
    for (std::size_t index = 0; index < plan.items.size(); ++index) {
        const AnnotationPlan::Item& item = plan.items[index];
        const Drawing::Colors colors = item.drawing.colors_on(frame, item.ink, plan.halo_radius);
        const Shapes shapes = item.drawing.shapes();
        if (colors.halo) {
            std::string halo = pdf_color(*colors.halo, "rg") + pdf_color(*colors.halo, "RG") + "1 j " +
                               pdf_numbers({2 * plan.halo_radius}) + "w\n";
            for (const Drawing::Shape& shape : shapes) {
                const std::string path = shape.has_halo ? pdf_path(shape.mask) : "";
                halo += path + (path.empty() ? "" : "B\n");
            }
            // As one shape: where halos overlap they are no denser.
            const std::string box = pdf_numbers({0, 0, double(frame.width), double(frame.height)});
            const int object = file.add_stream("/Type /XObject /Subtype /Form /BBox [" + box +
                                                   "] /Group << /S /Transparency /CS /DeviceRGB >> /Resources << >>",
                                               halo);
            const std::string name = std::string("/H") + std::to_string(index);
            result.objects += name + " " + pdf_reference(object) + " ";
            result.operators += "q " + set_opacity((*colors.halo)[3]) + name + " Do Q\n";
        }
        for (std::size_t at = 0; at < shapes.size();) {
            const Shapes rows = rows_at(shapes.subspan(at));
            if (!rows.empty()) {
                result.operators += pdf_rows(rows);
                at += rows.size();
                continue;
            }
            const Mask& mask = shapes[at].mask;
            const Color color = shapes[at++].color.value_or(colors.ink);
            if (mask.box.is_empty()) {
                continue;
            }
            result.operators += "q " + (color[3] < 1 ? set_opacity(color[3]) : "") + pdf_color(color, "rg");
            if (mask.text) {
                result.operators +=
                    fonts.show(*mask.text, {mask.box.left + mask.text->baseline[0], mask.box.top + mask.text->baseline[1]});
            } else {
                result.operators += pdf_path(mask) + (mask.polygon.empty() ? "" : "f\n");
            }
            result.operators += "Q\n";
        }
    }
    result.resources = "/ExtGState << " + opacities + ">> /Font << " + fonts.write(file) + ">>";
    return result;
}

} // namespace elvis
