#include <core/annotation/items.hpp>
#include <core/annotation/ticks.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace elvis {

namespace {

Mask rectangle(int left, int top, int right, int bottom) {
    Mask mask = empty_mask({left, top, right, bottom});
    std::fill(mask.coverage.begin(), mask.coverage.end(), 1.0f);
    const double width = mask.box.width(), height = mask.box.height();
    mask.polygon = {{0, 0}, {width, 0}, {width, height}, {0, height}};
    return mask;
}

Color opaque(const std::array<double, 3>& rgb) { return {rgb[0], rgb[1], rgb[2], 1}; }

double range_at(const ColorTable& table, double fraction) {
    const double low = table.points.front().value, high = table.points.back().value;
    if (table.is_logarithmic) {
        return std::exp((1 - fraction) * std::log(low) + fraction * std::log(high));
    }
    return (1 - fraction) * low + fraction * high;
}

/** The inverse. */
double fraction_of(const ColorTable& table, double value) {
    const double low = table.points.front().value, high = table.points.back().value;
    if (!(high > low)) {
        return 0.5;
    }
    return table.is_logarithmic ? (std::log(value) - std::log(low)) / (std::log(high) - std::log(low))
                                : (value - low) / (high - low);
}

/** Height of the triangles that stand for values outside. */
int tip_height(const ItemStyle& style) { return style.bar_width; }

/** The bar's outline with its tips, grown by `by` on all sides, so that painted below the colours it frames them. */
std::vector<Point2> outline(const ColorBar& bar, const ItemStyle& style, double by) {
    const double width = style.bar_width, length = style.bar_length, tip = tip_height(style);
    const double half = 0.5 * width, slant = std::hypot(half, tip);
    // Where a side of the tip, moved outwards, meets the bar's side and the middle, both moved too.
    const double shoulder = by * (slant - tip) / half, point = tip + by * slant / half;
    std::vector<Point2> points;
    if (bar.has_above) {
        points.insert(points.end(), {{-by, -shoulder}, {half, -point}, {width + by, -shoulder}});
    } else {
        points.insert(points.end(), {{-by, -by}, {width + by, -by}});
    }
    if (bar.has_below) {
        points.insert(points.end(), {{width + by, length + shoulder}, {half, length + point}, {-by, length + shoulder}});
    } else {
        points.insert(points.end(), {{width + by, length + by}, {-by, length + by}});
    }
    return points;
}

void add_colors(Drawing& drawing, const ColorBar& bar, const ItemStyle& style) {
    const int width = style.bar_width, length = style.bar_length;
    drawing.add(polygon_mask(outline(bar, style, style.line)));
    for (int row = 0; row < length; ++row) {
        const double value = range_at(bar.colors, 1 - (row + 0.5) / length);
        drawing.add(rectangle(0, row, width, row + 1), table_color(bar.colors, value));
    }
    const double w = width, tip = tip_height(style);
    if (bar.has_above) {
        drawing.add(polygon_mask(std::array<Point2, 3>{{{0, 0}, {0.5 * w, -tip}, {w, 0}}}), bar.colors.above);
    }
    if (bar.has_below) {
        const double end = length;
        drawing.add(polygon_mask(std::array<Point2, 3>{{{0, end}, {0.5 * w, end + tip}, {w, end}}}), bar.colors.below);
    }
}

/** Name with unit, no longer than the bar: smaller, and at last cut short, where it must be. */
Mask name_mask(const Font& font, const ColorBar& bar, const ItemStyle& style) {
    std::string text = bar.name;
    if (!bar.unit.empty()) {
        text += (text.empty() ? "[" : " [") + bar.unit + "]";
    }
    if (text.empty()) {
        return {};
    }
    const double wanted = font.advance(text, style.text);
    const double room = style.bar_length;
    constexpr double least_scale = 0.75;
    const double size = style.text * std::clamp(room / wanted, least_scale, 1.0);
    while (!text.empty() && font.advance(text, size) > room) {
        // Drop a whole character: bytes of the form 10xxxxxx continue one.
        const bool was_cut = text.ends_with("…");
        text.resize(text.size() - (was_cut ? std::string("…").size() : 0));
        do {
            text.pop_back();
        } while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80);
        if (!text.empty()) {
            // What is left ends with the first byte of a longer character if its others are gone.
            if (static_cast<unsigned char>(text.back()) >= 0xC0) {
                text.pop_back();
            }
            text += "…";
        }
    }
    return font.text(text, size, true);
}

} // namespace

Color table_color(const ColorTable& table, double value) {
    if (!std::isfinite(value) || (table.is_logarithmic && value <= 0)) {
        return table.nan;
    }
    const auto above = std::upper_bound(table.points.begin(), table.points.end(), value,
                                        [](double v, const ColorTable::Point& point) { return v < point.value; });
    if (above == table.points.begin()) {
        return table.below;
    }
    const ColorTable::Point& from = *(above - 1);
    if (above == table.points.end()) {
        return value > from.value ? table.above : opaque(from.rgb);
    }
    const double t = (value - from.value) / (above->value - from.value);
    Color color{0, 0, 0, 1};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        color[channel] = from.rgb[channel] + t * (above->rgb[channel] - from.rgb[channel]);
    }
    return color;
}

Drawing color_bar(const Font& font, const ColorBar& bar, const ItemStyle& style) {
    Drawing drawing;
    if (bar.colors.points.empty()) {
        return drawing;
    }
    add_colors(drawing, bar, style);

    const double low = bar.colors.points.front().value, high = bar.colors.points.back().value;
    // Numbers stand apart by at least their own height and a half.
    const int most = std::clamp(static_cast<int>(style.bar_length / (2.5 * style.text)) + 1, 2, 8);
    const Ticks ticks = bar.colors.is_logarithmic ? logarithmic_ticks(low, high, most) : round_ticks(low, high, most);
    const int gap = std::max(2, static_cast<int>(std::lround(0.3 * style.text)));
    const int tick_begin = style.bar_width + style.line, tick_end = tick_begin + gap;
    const auto digits = static_cast<int>(std::lround(font.digit_height(style.text)));

    std::vector<Mask> labels;
    int label_width = 0;
    for (const Tick& tick : ticks.ticks) {
        const auto center =
            static_cast<int>(std::lround((1 - fraction_of(bar.colors, tick.value)) * style.bar_length - 0.5 * style.line));
        if (tick.label.empty()) {
            drawing.add(rectangle(tick_begin, center, tick_begin + std::max(1, gap / 2), center + style.line));
            continue;
        }
        drawing.add(rectangle(tick_begin, center, tick_end, center + style.line));
        labels.push_back(text_at(font, tick.label, style.text, 0, center + (style.line + digits) / 2));
        label_width = std::max(label_width, labels.back().box.right);
    }
    // Aligned at the right, so that their points are one below the other.
    const int label_begin = tick_end + gap;
    int right = label_begin + label_width;
    for (Mask& label : labels) {
        label.box = moved(label.box, right - label.box.right, 0);
        drawing.add(std::move(label));
    }

    if (!ticks.scale.empty()) {
        Mask scale = text_at(font, ticks.scale, style.text, 0, 0);
        const int bottom = drawing.box().top - gap;
        // Ends where the labels end, as long as it does not stick out at the left.
        scale.box = moved(scale.box, std::max(0, right - scale.box.right), bottom - scale.box.bottom);
        drawing.add(std::move(scale));
    }
    Mask name = name_mask(font, bar, style);
    if (!name.box.is_empty()) {
        name.box =
            moved(name.box, right + gap + gap / 2 - name.box.left, (style.bar_length - name.box.height()) / 2 - name.box.top);
        drawing.add(std::move(name));
    }
    if (bar.has_nan) {
        const int top = style.bar_length + (bar.has_below ? tip_height(style) : 0) + std::max(digits, 2 * gap);
        const int line = style.line, width = style.bar_width;
        drawing.add(rectangle(-line, top - line, width + line, top + width + line));
        drawing.add(rectangle(0, top, width, top + width), bar.colors.nan);
        const char* text = bar.colors.is_logarithmic ? "≤ 0, NaN" : "NaN";
        drawing.add(text_at(font, text, style.text, label_begin, top + (width + digits) / 2));
    }
    return drawing;
}

} // namespace elvis
