#include "pictures.hpp"

#include <core/annotation/items.hpp>

#include <catch2/catch.hpp>

using namespace elvis;
using namespace elvis::test;

namespace {

/** Independent of the program's: the last segment that holds the value. */
Color expected(const ColorTable& table, double value) {
    for (std::size_t i = table.points.size() - 1; i > 0; --i) {
        const ColorTable::Point &a = table.points[i - 1], &b = table.points[i];
        if (value >= a.value && value <= b.value && a.value < b.value) {
            const double t = (value - a.value) / (b.value - a.value);
            return {(1 - t) * a.rgb[0] + t * b.rgb[0], (1 - t) * a.rgb[1] + t * b.rgb[1], (1 - t) * a.rgb[2] + t * b.rgb[2], 1};
        }
    }
    return {};
}

bool are_close(const Color& a, const Color& b) {
    for (std::size_t channel = 0; channel < 4; ++channel) {
        // Two ways to write the same line.
        if (std::abs(a[channel] - b[channel]) > 1e-14) {
            return false;
        }
    }
    return true;
}

} // namespace

TEST_CASE("the bar's pixels have the colours of the table at their values") {
    const Font font;
    ColorBar bar;
    bar.colors = stepped_table();
    bar.name = "pressure";
    bar.has_below = bar.has_above = bar.has_nan = true;
    ItemStyle style;
    style.bar_length = 257;
    style.bar_width = 21;
    Drawing drawing = color_bar(font, bar, style);
    drawing.move(60, 80);
    Frame frame = plain(300, 500, {0.2, 0.5, 0.6, 1});
    drawing.paint(frame, std::nullopt, 2);
    int below_step = 0, above_step = 0;
    for (int row = 0; row < style.bar_length; ++row) {
        const double value = 2 - 3 * (row + 0.5) / style.bar_length;
        const Color color = expected(bar.colors, value);
        for (int column = 0; column < style.bar_width; ++column) {
            REQUIRE(are_close(color_at(frame, 60 + column, 80 + row), color));
        }
        (value < 0.25 ? below_step : above_step) += 1;
    }
    CHECK(below_step > 100);
    CHECK(above_step > 100);
    // The tips, and below them the colour of what is no number.
    CHECK(color_at(frame, 60 + 10, 80 - 4) == bar.colors.above);
    CHECK(color_at(frame, 60 + 10, 80 + style.bar_length + 4) == bar.colors.below);
    bool has_nan = false;
    for (int row = 80 + style.bar_length + style.bar_width; row < 500; ++row) {
        has_nan = has_nan || color_at(frame, 70, row) == bar.colors.nan;
    }
    CHECK(has_nan);
}

TEST_CASE("colours for values that do not occur are not shown") {
    const Font font;
    ColorBar bar;
    bar.colors = stepped_table();
    ItemStyle style;
    Drawing drawing = color_bar(font, bar, style);
    drawing.move(60, 80);
    Frame frame = plain(300, 600);
    drawing.paint(frame, std::nullopt, 2);
    for (std::size_t pixel = 0; pixel < frame.value.size(); ++pixel) {
        const Color color = {frame.color[4 * pixel], frame.color[4 * pixel + 1], frame.color[4 * pixel + 2],
                             frame.color[4 * pixel + 3]};
        REQUIRE(color != bar.colors.below);
        REQUIRE(color != bar.colors.above);
        REQUIRE(color != bar.colors.nan);
    }
}

TEST_CASE("every tick stands beside the colour of its value") {
    const Font font;
    ColorBar bar;
    bar.colors = stepped_table();
    ItemStyle style;
    style.bar_length = 300;
    style.line = 1;
    Drawing drawing = color_bar(font, bar, style);
    drawing.move(40, 50);
    Frame frame = plain(300, 400);
    drawing.paint(frame, std::nullopt, 2);
    // Ticks of [-1, 2] are -1, -0.5, ... 2; the line of one pixel holds the value's place, but at the ends.
    int found = 0;
    for (int half = -2; half <= 4; ++half) {
        const double place = (2 - 0.5 * half) / 3 * style.bar_length;
        for (int row = -2; row <= style.bar_length + 2; ++row) {
            const bool is_black = pixel(frame, 40 + style.bar_width + 2, 50 + row)[0] < 0.1;
            found += is_black && std::abs(row + 0.5 - place) <= 0.5 + 1e-9 ? 1 : 0;
        }
    }
    // Each is in one row, or astride the border of two.
    CHECK(found >= 7);
    CHECK(found <= 14);
    int black = 0;
    for (int row = -20; row <= style.bar_length + 20; ++row) {
        black += pixel(frame, 40 + style.bar_width + 2, 50 + row)[0] < 0.1 ? 1 : 0;
    }
    CHECK(black == 7);
}

TEST_CASE("values outside the table have the colours that are kept for them") {
    const ColorTable table = stepped_table();
    CHECK(table_color(table, -1.001) == table.below);
    CHECK(table_color(table, 2.001) == table.above);
    CHECK(table_color(table, std::nan("")) == table.nan);
    CHECK(table_color(table, 2) == Color{0.9, 0.9, 0.05, 1});
    CHECK(table_color(table, -1) == Color{0.1, 0.2, 0.9, 1});
    // At a step the upper side, as in the picture.
    CHECK(table_color(table, 0.25) == Color{0.1, 0.7, 0.3, 1});
}
