#include <core/annotation/items.hpp>
#include <core/annotation/plan.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace elvis {

namespace {

/** Hands out places of the picture, each once. */
class Layout {
public:
    Layout(const PixelBox& picture, int margin) : m_picture(picture), m_margin(margin) {}

    const PixelBox& picture() const { return m_picture; }
    int margin() const { return m_margin; }

    bool is_inside(const PixelBox& box) const { return m_picture.contains(grown(box, 1)); }

    /** The first item that would be too near. */
    const PixelBox* hindrance(const PixelBox& box) const {
        const PixelBox wanted = grown(box, std::max(2, m_margin / 2));
        const auto found =
            std::find_if(m_taken.begin(), m_taken.end(), [&](const PixelBox& other) { return other.meets(wanted); });
        return found == m_taken.end() ? nullptr : &*found;
    }

    bool is_free(const PixelBox& box) const { return is_inside(box) && !hindrance(box); }
    void take(const PixelBox& box) { m_taken.push_back(box); }

private:
    PixelBox m_picture;
    int m_margin;
    std::vector<PixelBox> m_taken;
};

void move_to(Drawing& drawing, int left, int top) { drawing.move(left - drawing.box().left, top - drawing.box().top); }

struct Place {
    int left, top;
};

/** Moves the drawing to the first place that is free. */
bool place(Drawing& drawing, Layout& layout, const std::vector<Place>& places) {
    for (const Place& candidate : places) {
        move_to(drawing, candidate.left, candidate.top);
        if (layout.is_free(drawing.box())) {
            layout.take(drawing.box());
            return true;
        }
    }
    return false;
}

bool place_text(Drawing& drawing, const AnnotationText& text, Layout& layout) {
    const int room_x = layout.picture().right - drawing.box().width() - 1,
              room_y = layout.picture().bottom - drawing.box().height() - 1;
    const double x = text.position[0] * layout.picture().right - text.anchor[0] * drawing.box().width();
    const double y = text.position[1] * layout.picture().bottom - text.anchor[1] * drawing.box().height();
    if (room_x < 1 || room_y < 1) {
        return false;
    }
    // Clamped as doubles: a position far outside need not fit into an int.
    return place(drawing, layout,
                 {{static_cast<int>(std::lround(std::clamp<double>(x, 1, room_x))),
                   static_cast<int>(std::lround(std::clamp<double>(y, 1, room_y)))}});
}

bool place_title(Drawing& drawing, Layout& layout) {
    const PixelBox& picture = layout.picture();
    constexpr int least_share = 3;
    return drawing.box().height() * least_share <= picture.height() &&
           place(drawing, layout, {{(picture.width() - drawing.box().width()) / 2, layout.margin()}});
}

/**
 * With its colours in the middle of the height, so that bars side by side are level; from the side inwards past what is there
 * already, within half of the width. `bar_length` is the height of its colours, which begin at row 0 before it is moved.
 */
bool place_bar(Drawing& drawing, int bar_length, bool at_left, Layout& layout) {
    const PixelBox& picture = layout.picture();
    const int width = drawing.box().width(), height = drawing.box().height();
    const int highest = layout.margin(), lowest = std::max(highest, picture.height() - layout.margin() - height);
    const int level = std::clamp((picture.height() - bar_length) / 2 + drawing.box().top, highest, lowest);
    // Then where there is room, as below a long title and above texts.
    for (const int top : {level, (level + lowest) / 2, lowest, (level + highest) / 2, highest}) {
        int left = at_left ? layout.margin() : picture.width() - layout.margin() - width;
        while (at_left ? left + width <= picture.width() / 2 : left >= picture.width() / 2) {
            move_to(drawing, left, top);
            if (!layout.is_inside(drawing.box())) {
                break;
            }
            const PixelBox* other = layout.hindrance(drawing.box());
            if (!other) {
                layout.take(drawing.box());
                return true;
            }
            left = at_left ? other->right + layout.margin() : other->left - layout.margin() - width;
        }
    }
    return false;
}

bool place_axes(Drawing& drawing, Layout& layout) {
    const PixelBox& picture = layout.picture();
    const int width = drawing.box().width(), height = drawing.box().height();
    if (2 * width > picture.width() || 2 * height > picture.height()) {
        return false;
    }
    const int left = layout.margin(), right = picture.width() - layout.margin() - width;
    const int top = layout.margin(), bottom = picture.height() - layout.margin() - height;
    return place(drawing, layout, {{left, bottom}, {right, bottom}, {left, top}, {right, top}});
}

/** Places the bar at the length asked for, or shorter where the picture has no room for that. */
bool place_fitting_bar(Drawing& drawing, const Font& font, const ColorBar& bar, ItemStyle style, bool at_left, Layout& layout) {
    // Shorter than this nothing can be read from it.
    const double least = std::max(3.0 * style.bar_width, 3 * style.text);
    constexpr double shorter = 0.85;
    do {
        drawing = color_bar(font, bar, style);
        if (!drawing.is_empty() && place_bar(drawing, style.bar_length, at_left, layout)) {
            return true;
        }
        style.bar_length = static_cast<int>(shorter * style.bar_length);
    } while (style.bar_length >= least);
    return false;
}

} // namespace

Drawing text_block(const Font& font, const std::string& text, double size, double align) {
    Drawing drawing;
    std::istringstream stream(text);
    std::vector<Mask> lines;
    std::string line;
    int width = 0;
    while (std::getline(stream, line)) {
        const auto y = static_cast<int>(std::lround(static_cast<double>(lines.size()) * font.line_height(size)));
        lines.push_back(text_at(font, line, size, 0, y));
        width = std::max(width, lines.back().box.right);
    }
    for (Mask& mask : lines) {
        mask.box = moved(mask.box, static_cast<int>(std::lround(align * (width - mask.box.right))), 0);
        if (!mask.box.is_empty()) {
            drawing.add(std::move(mask));
        }
    }
    return drawing;
}

AnnotationPlan plan_annotation(std::uint32_t width, std::uint32_t height, const AnnotationRequest& request) {
    AnnotationPlan plan;
    if (request.title.empty() && request.color_bars.empty() && !request.axes && request.texts.empty()) {
        return plan;
    }
    const Font font(request.font);
    const double side = std::min(width, height);
    const auto pixels = [side](double fraction) { return std::max(1, static_cast<int>(std::lround(fraction * side))); };
    ItemStyle style;
    style.text = std::max(request.least_text_pixels, request.text_size * side);
    style.line = std::max(1, static_cast<int>(std::lround(0.06 * style.text)));
    style.bar_length = pixels(request.bar_length);
    style.bar_width = std::max(6, pixels(request.bar_width));
    style.axes = std::max(2 * style.text, request.axes_size * side);
    plan.halo_radius = std::max(1.0, 0.1 * style.text);
    Layout layout({0, 0, static_cast<int>(width), static_cast<int>(height)},
                  std::max(2, static_cast<int>(std::lround(0.8 * style.text))));

    const auto finish = [&](Drawing drawing, bool has_place, const std::optional<Color>& color, const std::string& name) {
        if (has_place) {
            plan.items.push_back({std::move(drawing), color});
        } else if (!drawing.is_empty()) {
            plan.left_out.push_back(name);
        }
    };
    for (const AnnotationText& text : request.texts) {
        const double size = text.size ? std::max(request.least_text_pixels, *text.size * side) : style.text;
        Drawing drawing = text_block(font, text.text, size, text.anchor[0]);
        const bool has_place = !drawing.is_empty() && place_text(drawing, text, layout);
        finish(std::move(drawing), has_place, text.color ? text.color : request.color, "text '" + text.text + "'");
    }
    if (!request.title.empty()) {
        double size = request.title_scale * style.text;
        Drawing drawing = text_block(font, request.title, size, 0.5);
        const double room = static_cast<double>(width) - 2 * layout.margin();
        if (drawing.box().width() > room) {
            size = std::max(request.least_text_pixels, size * room / drawing.box().width());
            drawing = text_block(font, request.title, size, 0.5);
        }
        const bool has_place = !drawing.is_empty() && place_title(drawing, layout);
        finish(std::move(drawing), has_place, request.color, "title");
    }
    for (const ColorBar& bar : request.color_bars) {
        Drawing drawing;
        const bool has_place = place_fitting_bar(drawing, font, bar, style, request.bars_at_left, layout);
        finish(std::move(drawing), has_place, request.color, "color bar" + (bar.name.empty() ? "" : " of " + bar.name));
    }
    if (request.axes) {
        Drawing drawing = axes_triad(font, *request.axes, style);
        const bool has_place = place_axes(drawing, layout);
        finish(std::move(drawing), has_place, request.color, "axes");
    }
    return plan;
}

void paint(Frame& frame, const AnnotationPlan& plan) {
    for (const AnnotationPlan::Item& item : plan.items) {
        item.drawing.paint(frame, item.ink, plan.halo_radius);
    }
}

std::vector<std::string> annotate(Frame& frame, const AnnotationRequest& request) {
    const AnnotationPlan plan = plan_annotation(frame.width, frame.height, request);
    paint(frame, plan);
    return plan.left_out;
}

} // namespace elvis
