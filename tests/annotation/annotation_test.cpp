#include "pictures.hpp"

#include <core/annotation/items.hpp>
#include <core/base/error.hpp>

#include <catch2/catch.hpp>

#include <random>

using namespace elvis;
using namespace elvis::test;

namespace {

AnnotationRequest everything() {
    AnnotationRequest request;
    request.title = "Strömung um einen Zylinder, Re = 3900";
    ColorBar bar;
    bar.colors = stepped_table();
    bar.name = "pressure";
    bar.unit = "Pa";
    bar.has_below = bar.has_above = bar.has_nan = true;
    request.color_bars = {bar, bar};
    request.color_bars[1].name = "|ω|";
    Camera camera;
    camera.eye = {2, 1, 3};
    camera.up = {0, 1, 0};
    request.axes = camera;
    request.texts = {{"order 6\n∂p/∂x", {0, 0.5}, {0, 0.5}, std::nullopt, std::nullopt}};
    return request;
}

/** Which pixels an annotation changes. */
std::vector<bool> changed(const Frame& before, const Frame& after) {
    std::vector<bool> result(before.value.size());
    for (std::size_t pixel = 0; pixel < result.size(); ++pixel) {
        for (std::size_t channel = 0; channel < 4; ++channel) {
            result[pixel] = result[pixel] || before.color[4 * pixel + channel] != after.color[4 * pixel + channel];
        }
    }
    return result;
}

} // namespace

TEST_CASE("annotation changes colours and nothing else, the same every time") {
    const Frame before = plain(640, 480, {0.3, 0.3, 0.3, 1});
    Frame once = before, twice = before;
    CHECK(annotate(once, everything()).empty());
    annotate(twice, everything());
    CHECK(once.color != before.color);
    CHECK(once.color == twice.color);
    CHECK(once.value == before.value);
    CHECK(once.depth == before.depth);
    CHECK(once.element == before.element);
    CHECK(once.normal == before.normal);
    CHECK(once.flags == before.flags);
    const auto [least, most] = std::minmax_element(once.color.begin(), once.color.end());
    CHECK((*least >= 0 && *most <= 1));
}

TEST_CASE("nothing asked for leaves the picture as it is and needs no font") {
    Frame frame = plain(64, 64, {0.1, 0.2, 0.3, 0.4});
    const Frame before = frame;
    AnnotationRequest request;
    request.font = "/no/such/font.ttf";
    CHECK(annotate(frame, request).empty());
    CHECK(frame.color == before.color);
    request.title = "needs a font";
    CHECK_THROWS_WITH(annotate(frame, request), Catch::Contains("/no/such/font.ttf"));
}

TEST_CASE("items never overlap, whatever the size of the picture") {
    // Each item alone, on a picture that has them all, is where it is in the whole: the masks of two never share a pixel.
    std::mt19937 random(23);
    std::uniform_int_distribution<std::uint32_t> size(1, 500);
    int drawn = 0, left_out = 0;
    for (int repetition = 0; repetition < 40; ++repetition) {
        const std::uint32_t width = repetition == 0 ? 64 : size(random), height = repetition == 0 ? 48 : size(random);
        const Frame before = plain(width, height);
        AnnotationRequest request = everything();
        // Colours tell the items apart.
        request.texts[0].color = Color{1, 0, 0, 1};
        Frame all = before;
        const std::size_t missing = annotate(all, request).size();
        left_out += static_cast<int>(missing);
        drawn += 5 - static_cast<int>(missing);
        // The title's pixels are those of a picture with the title and the text alone, and so on as items are added.
        std::vector<bool> sum(before.value.size());
        AnnotationRequest some;
        Frame last = before;
        const auto add = [&] {
            Frame next = before;
            annotate(next, some);
            const std::vector<bool> now = changed(last, next);
            std::size_t shared = 0;
            for (std::size_t pixel = 0; pixel < now.size(); ++pixel) {
                shared += now[pixel] && sum[pixel] ? 1 : 0;
                sum[pixel] = sum[pixel] || now[pixel];
            }
            REQUIRE(shared == 0);
            last = next;
        };
        some.texts = request.texts;
        add();
        some.title = request.title;
        add();
        some.color_bars = {request.color_bars[0]};
        add();
        some.color_bars = request.color_bars;
        add();
        some.axes = request.axes;
        add();
        CHECK(last.color == all.color);
    }
    std::printf("annotation: %d items drawn, %d left out\n", drawn, left_out);
    CHECK(drawn > 60);
    CHECK(left_out > 10);
}

TEST_CASE("items stay inside the picture") {
    // A border of one pixel stays free; with what would be cut off at it missing, an item cannot have run over it.
    for (const auto& [width, height] :
         std::vector<std::pair<std::uint32_t, std::uint32_t>>{{64, 48}, {100, 400}, {400, 100}, {1, 1}, {3, 200}, {320, 240}}) {
        const Frame before = plain(width, height);
        Frame after = before;
        AnnotationRequest request = everything();
        request.texts.push_back({"far right", {1e9, -1e9}, {0, 0}, std::nullopt, std::nullopt});
        annotate(after, request);
        const std::vector<bool> touched = changed(before, after);
        int on_border = 0;
        for (std::uint32_t row = 0; row < height; ++row) {
            for (std::uint32_t column = 0; column < width; ++column) {
                const bool is_border = row == 0 || column == 0 || row + 1 == height || column + 1 == width;
                on_border += is_border && touched[std::size_t{row} * width + column] ? 1 : 0;
            }
        }
        CHECK(on_border == 0);
    }
}

TEST_CASE("what finds no room is named") {
    Frame frame = plain(64, 48);
    const std::vector<std::string> missing = annotate(frame, everything());
    CHECK(std::find(missing.begin(), missing.end(), "color bar of pressure") != missing.end());
    Frame large = plain(800, 600);
    CHECK(annotate(large, everything()).empty());
}

TEST_CASE("ink is black on bright and white on dark pictures unless a colour is given") {
    AnnotationRequest request;
    request.title = "IIIIIIIIII";
    const auto extreme = [&](const Color& background) {
        Frame frame = plain(400, 300, background);
        annotate(frame, request);
        const auto [least, most] = std::minmax_element(frame.color.begin(), frame.color.end());
        return std::pair(*least, *most);
    };
    CHECK(extreme({0.9, 0.9, 0.9, 1}).first < 0.05);
    CHECK(extreme({0.9, 0.9, 0.9, 1}).second == 1); // alpha only: nothing is whiter than the picture
    CHECK(extreme({0.1, 0.1, 0.1, 1}).second == 1);
    Frame dark = plain(400, 300, {0.1, 0.1, 0.1, 1});
    annotate(dark, request);
    double brightest = 0;
    for (std::size_t pixel = 0; pixel < dark.value.size(); ++pixel) {
        brightest = std::max(brightest, dark.color[4 * pixel]);
    }
    CHECK(brightest > 0.95);
    request.color = Color{0, 0.5, 0.25, 1};
    Frame green = plain(400, 300);
    annotate(green, request);
    bool has_own = false;
    for (std::size_t pixel = 0; pixel < green.value.size(); ++pixel) {
        has_own = has_own || (green.color[4 * pixel] == 0 && green.color[4 * pixel + 1] == 0.5);
    }
    CHECK(has_own);
}

TEST_CASE("over transparent background text keeps its colour and brings its own opacity") {
    Frame frame = plain(2, 1, {0, 0, 0, 0});
    Mask half = empty_mask({0, 0, 1, 1});
    half.coverage[0] = 0.5f;
    blend(frame, half, {1, 0.5, 0.25, 1});
    CHECK(color_at(frame, 0, 0) == Color{1, 0.5, 0.25, 0.5});
    CHECK(color_at(frame, 1, 0) == Color{0, 0, 0, 0});
    // Display values are mixed as they are.
    Frame opaque = plain(1, 1, {0, 0, 1, 1});
    blend(opaque, half, {1, 1, 0, 1});
    CHECK(color_at(opaque, 0, 0) == Color{0.5, 0.5, 0.5, 1});
}

TEST_CASE("sizes scale with the picture") {
    const auto title_height = [](std::uint32_t side) {
        Frame frame = plain(2 * side, side);
        const Frame before = frame;
        AnnotationRequest request;
        request.title = "HHH";
        annotate(frame, request);
        const std::vector<bool> touched = changed(before, frame);
        int rows = 0;
        for (std::uint32_t row = 0; row < side; ++row) {
            bool any = false;
            for (std::uint32_t column = 0; column < 2 * side; ++column) {
                any = any || touched[std::size_t{row} * 2 * side + column];
            }
            rows += any ? 1 : 0;
        }
        return rows;
    };
    CHECK(std::abs(title_height(2000) - 2 * title_height(1000)) <= 2);
}
