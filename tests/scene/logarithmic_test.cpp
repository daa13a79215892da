// Colours on a logarithmic scale, against the formula.

#include "fixture.hpp"
#include "stage.hpp"

#include <core/scene/color/color_map.hpp>
#include <core/scene/color/transfer.hpp>
#include <core/scene/scene_annotation.hpp>

#include <algorithm>
#include <cmath>

using namespace elvis;
using namespace elvis::test;
using Catch::Matchers::Contains;

namespace {

/** From black to white: a channel is the place on the scale. */
const std::string ramp = R"("points": [[0, 0, 0, 0], [1, 1, 1, 1]], "scale": "logarithmic")";
/** With colours that occur nowhere else. */
const std::string marks = R"(, "below": [0, 0, 1], "above": [1, 0, 0], "nan": [0, 1, 0])";

std::string scene(const std::string& field, const std::string& map) {
    return R"("field": ")" + field + R"(", "color_map": {)" + map +
           R"(}, "image": {"size": [120, 90]}, "surfaces": [{"type": "plane", "plane": [0.2, 0.1, 1, 0.07]}])";
}

double place(double value, double lower, double upper) { return std::log(value / lower) / std::log(upper / lower); }

struct Counts {
    int inside = 0, below = 0, above = 0, without = 0;
};

/** Each pixel's colour is what the formula says of its value. */
Counts check_colors(const Frame& frame, double lower, double upper, double tolerance) {
    Counts counts;
    // Values are read back with the digits that they have on the device.
    const double edge = 1e-5;
    double worst = 0;
    for (std::size_t pixel = 0; pixel < frame.value.size(); ++pixel) {
        const double value = frame.value[pixel];
        if (!std::isfinite(value)) {
            continue;
        }
        const Rgb rgb = {frame.color[4 * pixel], frame.color[4 * pixel + 1], frame.color[4 * pixel + 2]};
        if (value <= 0) {
            counts.without += 1;
            REQUIRE(rgb == Rgb{0, 1, 0});
        } else if (value < lower * (1 - edge)) {
            counts.below += 1;
            REQUIRE(rgb == Rgb{0, 0, 1});
        } else if (value > upper * (1 + edge)) {
            counts.above += 1;
            REQUIRE(rgb == Rgb{1, 0, 0});
        } else if (value > lower && value < upper) {
            counts.inside += 1;
            for (const double channel : rgb) {
                worst = std::max(worst, std::abs(channel - place(value, lower, upper)));
            }
        }
    }
    CHECK(worst <= tolerance);
    return counts;
}

} // namespace

TEST_CASE("Colours on a logarithmic scale are where the formula has them, in both precisions") {
    for (const Precision precision : {Precision::float32, Precision::float64}) {
        Stage stage(precision);
        const bool is_single = precision == Precision::float32;
        CAPTURE(is_single);
        // The field's digits are those of its value here: colours are found from the value that is read back.
        const double rounding = is_single ? 1e-6 : 0;
        {
            // About six decades of a function that is above 0.
            const FrameRequest request = stage.request(scene("bump", ramp + R"(, "range": [1e-5, 0.8])" + marks));
            const Counts counts = check_colors(stage.renderer.render(request), 1e-5, 0.8, 1.01e-5 + rounding);
            CHECK(counts.inside > 1000);
            CHECK(counts.above > 50);
        }
        {
            // One that is above 0 in one half only.
            const FrameRequest request = stage.request(scene("x", ramp + R"(, "range": [0.1, 0.9])" + marks));
            const Frame frame = stage.renderer.render(request);
            const Counts counts = check_colors(frame, 0.1, 0.9, 1.01e-5 + rounding);
            for (const int count : {counts.inside, counts.below, counts.above, counts.without}) {
                CHECK(count > 50);
            }
            // Its bar tells all three.
            const auto bars = make_annotation_request({}, request, frame, stage.volume).color_bars;
            REQUIRE(bars.size() == 1);
            CHECK((bars[0].has_below && bars[0].has_above && bars[0].has_nan));
            CHECK(bars[0].colors.is_logarithmic);
            CHECK(frame.counts.nan_pixels == 0);
        }
    }
}

TEST_CASE("A surface that stays within the range has no tips on its bar") {
    Stage stage;
    const FrameRequest request = stage.request(scene("x * x + 1e-3", ramp));
    const Frame frame = stage.renderer.render(request);
    const auto bars = make_annotation_request({}, request, frame, stage.volume).color_bars;
    REQUIRE(bars.size() == 1);
    CHECK_FALSE((bars[0].has_below || bars[0].has_above || bars[0].has_nan));
}

TEST_CASE("Tables of every map are within their tolerance on a logarithmic scale") {
    for (const std::string& name : color_map_names()) {
        for (const std::array<double, 2>& range : {std::array{1e-9, 1e3}, std::array{2.0, 2.0001}, std::array{1e-300, 1e300}}) {
            SceneColorMap map;
            map.name = name;
            const ColorTable linear = make_color_table(map, {0, 1}, 1e-7);
            map.is_logarithmic = true;
            const ColorTable table = make_color_table(map, range);
            CAPTURE(name, range[0], range[1], table.points.size());
            CHECK((table.points.front().value == range[0] && table.points.back().value == range[1]));
            CHECK(std::is_sorted(table.points.begin(), table.points.end(),
                                 [](const auto& a, const auto& b) { return a.value < b.value; }));
            double worst = 0;
            for (int i = 0; i < 5000; ++i) {
                const double t = (i + 0.5) / 5000;
                const double value = std::exp((1 - t) * std::log(range[0]) + t * std::log(range[1]));
                const Color is = table_color(table, value), wanted = table_color(linear, t);
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    worst = std::max(worst, std::abs(is[channel] - wanted[channel]));
                }
            }
            CHECK(worst <= 1.2 * surface_table_tolerance);
        }
    }
}

TEST_CASE("Counted contours divide a logarithmic range by ratios") {
    Stage stage;
    const FrameRequest request =
        stage.request(scene("bump", ramp + R"(, "range": [1e-4, 1])") + R"(, "contours": {"count": 3})");
    const std::vector<double>& values = request.surfaces[0].contours->values;
    REQUIRE(values.size() == 3);
    CHECK(values[0] == Approx(1e-3));
    CHECK(values[1] == Approx(1e-2));
    CHECK(values[2] == Approx(1e-1));
}

TEST_CASE("A volume on a logarithmic scale has the scale's colours, density and bar") {
    Stage stage;
    const FrameRequest request = stage.request(R"("field": "bump", "volume_rendering": {"color_map": {)" + ramp +
                                               R"(, "range": [1e-4, 1])" + marks + "}}");
    REQUIRE(request.volume);
    const TransferFunction& transfer = request.volume->transfer;
    const double top = default_density(stage.diagonal());
    for (const double value : {1.3e-4, 0.001, 0.0205, 0.4}) {
        const double t = place(value, 1e-4, 1);
        CHECK(interpolated(transfer.density, value, [](const auto& point) { return point.density; }) ==
              Approx(top * t).margin(1.1e-3 * top));
        CHECK(interpolated(transfer.color, value, [](const auto& point) { return point.rgb[1]; }) == Approx(t).margin(1.1e-4));
    }
    const auto blue = [&](double value) { return interpolated(transfer.color, value, [](const auto& p) { return p.rgb[2]; }); };
    const auto green = [&](double value) {
        return interpolated(transfer.color, value, [](const auto& p) { return p.rgb[1]; });
    };
    CHECK((blue(5e-5) == 1 && green(5e-5) == 0));
    CHECK((blue(-1) == 0 && green(-1) == 1));
    Frame frame;
    const auto bars = make_annotation_request({}, request, frame, stage.volume).color_bars;
    REQUIRE(bars.size() == 1);
    CHECK(bars[0].colors.is_logarithmic);
    CHECK(bars[0].colors.points.front().value == 1e-4);
}

TEST_CASE("A logarithmic scale without a range above 0 is an error that says what to do") {
    Stage stage;
    CHECK_THAT(error_of([&] { stage.request(scene("wave", ramp)); }), Contains("above 0") && Contains("range"));
    CHECK_THAT(error_of([&] { stage.request(scene("wave", ramp + R"(, "range": [0, 1])")); }), Contains("above 0"));
    CHECK_THAT(error_of([&] { stage.request(scene("wave", R"("scale": "cubic")")); }), Contains("scale"));
}
