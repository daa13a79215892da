#include "pictures.hpp"

#include <core/annotation/svg.hpp>
#include <core/annotation/utf8.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <regex>
#include <string>

using namespace elvis;
using namespace elvis::test;

namespace {

AnnotationRequest bar_and_axes() {
    AnnotationRequest request;
    request.title = "p < 1 & \"q\"";
    ColorBar bar;
    bar.colors = stepped_table();
    bar.name = "pressure";
    bar.unit = "Pa";
    bar.has_above = true;
    request.color_bars = {bar};
    Camera camera;
    camera.eye = {2, 1, 3};
    camera.up = {0, 1, 0};
    request.axes = camera;
    return request;
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) {
        ++count;
    }
    return count;
}

} // namespace

TEST_CASE("What annotation covers can be uncovered") {
    const Frame before = plain(320, 240, {0.3, 0.3, 0.3, 1});
    Frame frame = before;
    const AnnotationPlan plan = plan_annotation(frame.width, frame.height, bar_and_axes());
    const std::vector<CoveredPart> covered = covered_by(plan, frame);
    paint(frame, plan);
    CHECK(frame.color != before.color);
    uncover(frame, covered);
    CHECK(frame.color == before.color);
}

TEST_CASE("The elements of SVG lie where annotation is painted, in its colours") {
    const Frame before = plain(320, 240);
    Frame frame = before;
    const AnnotationPlan plan = plan_annotation(frame.width, frame.height, bar_and_axes());
    const std::string text = svg_elements(plan, frame);
    paint(frame, plan);
    // Rows of the colour bar: whole pixels of one colour.
    const std::regex row(
        "<polygon points=\"([0-9.]+),([0-9.]+) ([0-9.]+),[0-9.]+ [^\"]*\" fill=\"#(..)(..)(..)\" shape-rendering");
    std::size_t n_rows = 0;
    for (std::sregex_iterator found(text.begin(), text.end(), row), end; found != end; ++found) {
        const auto column = static_cast<int>(0.5 * (std::stod((*found)[1]) + std::stod((*found)[3])));
        const Color color = color_at(frame, column, static_cast<int>(std::stod((*found)[2])));
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double shown = std::stoi((*found)[4 + channel], nullptr, 16) / 255.0;
            CHECK(std::abs(shown - color[channel]) <= 0.5 / 255 + 1e-12);
        }
        ++n_rows;
    }
    CHECK(n_rows > 140);
    CHECK(text.find(">p &lt; 1 &amp; &quot;q&quot;</text>") != std::string::npos);
    CHECK(text.find(">pressure [Pa]</text>") != std::string::npos);
    CHECK(count_of(text, "rotate(-90 ") == 1);
    CHECK(count_of(text, "font-family=\"'DejaVu Sans', sans-serif\"") == count_of(text, "<text "));
    CHECK(count_of(text, "<g>") == 3);
    // On white nothing needs a halo.
    CHECK(count_of(text, "<g opacity") == 0);
}

TEST_CASE("Where a picture is both dark and bright, ink has a halo in SVG, too") {
    Frame frame = plain(320, 240);
    for (std::size_t i = 0; i < frame.color.size() / 4; i += 3) {
        std::fill_n(&frame.color[4 * i], 3, 0.05);
    }
    const std::string text = svg_elements(plan_annotation(frame.width, frame.height, bar_and_axes()), frame);
    CHECK(count_of(text, "<g opacity=\"0.8\"") >= 2);
    CHECK(count_of(text, "<g") == count_of(text, "</g>"));
}

TEST_CASE("Text that is no text is still XML") {
    AnnotationRequest request;
    request.title = "a\xff\x01"
                    "b\xef\xbf\xbe";
    const Frame frame = plain(320, 240);
    const std::string text = svg_elements(plan_annotation(frame.width, frame.height, request), frame);
    CHECK(text.find(">a\xef\xbf\xbd b\xef\xbf\xbd</text>") != std::string::npos);
}

TEST_CASE("UTF-8 is written as it was read") {
    const std::string text = "aé€😀";
    CHECK(encode_utf8(decode_utf8(text)) == text);
}
