// Colours as screens show them, which the device rounds.
#include <tests/support/test_volumes.hpp>

#include <core/oracle/samples/meshes.hpp>
#include <core/render/picture/screen_pass.hpp>
#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace elvis::oracle {
namespace {

/** Each level's middle, both ends and the numbers beside them, in this precision, and what is no level. */
template <class Real> std::vector<double> channels_at_levels() {
    constexpr Real inf = std::numeric_limits<Real>::infinity(), nan = std::numeric_limits<Real>::quiet_NaN();
    std::vector<double> channels;
    const auto add = [&](Real channel) { channels.push_back(static_cast<double>(channel)); };
    for (const Real special : {nan, inf, -inf, Real(-0.25), Real(-0.0), Real(2), std::numeric_limits<Real>::min()}) {
        add(special);
    }
    for (int half = 0; half <= 511; ++half) {
        Real channel = static_cast<Real>(half / 510.0);
        for (int step = 0; step < 3; ++step) {
            channel = std::nextafter(channel, Real(-1));
        }
        for (int step = 0; step < 7; ++step) {
            add(channel);
            channel = std::nextafter(channel, Real(2));
        }
    }
    return channels;
}

std::uint8_t rounded(double channel) {
    return static_cast<std::uint8_t>(std::lround(255 * std::min(1.0, channel > 0 ? channel : 0.0)));
}

template <class Real> void check_levels(Precision precision) {
    const std::vector<double> channels = channels_at_levels<Real>();
    Layer layer(test::device(), precision, static_cast<std::uint32_t>(channels.size()), 1);
    std::vector<double> colors;
    for (const double channel : channels) {
        colors.insert(colors.end(), {channel, channel, 0.5, 1});
    }
    write_reals(layer.colors, precision, colors);
    const std::vector<std::uint8_t> shown =
        ScreenPass(test::device(), precision).draw(layer).read_items<std::uint8_t>(4 * layer.n_pixels());
    REQUIRE(shown.size() == colors.size());
    for (std::size_t pixel = 0; pixel < channels.size(); ++pixel) {
        INFO(channels[pixel]);
        REQUIRE(shown[4 * pixel] == rounded(channels[pixel]));
        REQUIRE(shown[4 * pixel + 1] == shown[4 * pixel]);
        REQUIRE(shown[4 * pixel + 3] == 255);
    }
}

} // namespace

TEST_CASE("The device rounds colours to the levels of PNG files") {
    check_levels<float>(Precision::float32);
    check_levels<double>(Precision::float64);
}

TEST_CASE("What a screen shows are the picture's colours, over grey where it is not opaque") {
    const TemporaryFile file("mixed.h5");
    generate(R"({"generator": 1, "mesh": "ball", "shape": "mixed", "elements": [2, 2, 2], "order": 3, "geometry_order": 2,)"
             R"( "field": "waves"})",
             file.path());
    const RuntimeVolume volume = open_volume(file.path());
    Renderer renderer(test::device(), volume, Precision::float64);
    FrameRequest request;
    request.width = 60;
    request.height = 40;
    request.camera.eye = {2.1, -1.7, 1.3};
    request.camera.look_at = {0, 0, 0};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 45;
    request.background = {0.2, 0.4, 0.6, 0.5};
    for (const bool is_empty : {true, false}) {
        if (!is_empty) {
            Surface surface;
            surface.geometry = Sphere{{0.1, 0, 0.2}, 0.7};
            surface.colors.points = {{-1, {0, 0, 1}}, {1, {1, 0, 0}}};
            request.surfaces = {surface};
        }
        request.for_screen = false;
        const Frame frame = renderer.render(request);
        request.for_screen = true;
        const Frame screen = renderer.render(request);
        CHECK(screen.color.empty());
        CHECK(screen.flags.empty());
        CHECK(screen.counts.hit_pixels == frame.counts.hit_pixels);
        CHECK((frame.counts.hit_pixels > 0) != is_empty);
        REQUIRE(screen.screen.size() == frame.color.size());
        for (std::size_t pixel = 0; pixel < frame.color.size() / 4; ++pixel) {
            Color color;
            std::copy_n(&frame.color[4 * pixel], 4, color.begin());
            REQUIRE(std::ranges::equal(on_screen(color), std::span(screen.screen).subspan(4 * pixel, 4)));
        }
    }
}

} // namespace elvis::oracle
