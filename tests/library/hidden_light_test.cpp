// Light of a volume between opaque things of the program that shows it.

#include "some_volume.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

using namespace elvis;
using test::convert;
using test::own_plugins;
using test::TemporaryFolder;

namespace {

/** The volume over a background that is not seen; with a plane in the middle, seen from above. */
scene light(const context& library, bool has_plane) {
    scene shown = library.make_scene();
    shown.set("/image", R"({"size": [40, 30], "background": [0, 0, 0, 0]})");
    shown.set("/camera", R"({"eye": [0.5, 0.4, 3], "look_at": [0.5, 0.5, 0.5], "up": [0, 1, 0], "field_of_view": 40})");
    shown.set("/volume_rendering", R"({"density": [[0, 0], [2, 2]], "color_map": {"name": "viridis"}})");
    if (has_plane) {
        shown.set("/surfaces/-", R"({"type": "plane", "plane": [0, 0, 1, -0.5]})");
    }
    return shown;
}

elvis_render_options hidden_from(const std::vector<double>& depths) {
    auto options = detail::sized<elvis_render_options>();
    options.hidden_from = depths.data();
    return options;
}

} // namespace

TEST_CASE("Light in front of a program's own things, put over them, is the picture with these things") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    const picture whole = volume.render(light(library, true));
    const std::vector<float> wanted = whole.read<float>(ELVIS_CHANNEL_COLOR);

    scene plane = light(library, true);
    plane.remove("/volume_rendering");
    const picture surfaces = volume.render(plane);
    const std::vector<float> under = surfaces.read<float>(ELVIS_CHANNEL_COLOR);
    std::vector<double> depths = surfaces.read<double>(ELVIS_CHANNEL_DEPTH);
    std::ranges::replace_if(
        depths, [](double depth) { return std::isnan(depth); }, std::numeric_limits<double>::infinity());
    const std::vector<float> over = volume.render(light(library, false), hidden_from(depths)).read<float>(ELVIS_CHANNEL_COLOR);

    double error = 0;
    std::size_t n_hidden = 0;
    for (std::size_t pixel = 0; pixel < depths.size(); ++pixel) {
        if (!std::isfinite(depths[pixel])) {
            continue;
        }
        ++n_hidden;
        const double alpha = over[4 * pixel + 3];
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const double put = alpha * over[4 * pixel + channel] + (1 - alpha) * under[4 * pixel + channel];
            error = std::max(error, std::abs(put - wanted[4 * pixel + channel]));
        }
    }
    std::printf("largest difference of a channel: %.2g in %zu pixels\n", error, n_hidden);
    CHECK(n_hidden > 300);
    CHECK(error < 1e-5);
}

TEST_CASE("Where nothing hides the volume all of its light is drawn, and none where all of it is hidden") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    const scene shown = light(library, false);
    const std::vector<double> far(40 * 30, std::numeric_limits<double>::infinity()), near(40 * 30, 0.0);
    CHECK(volume.render(shown, hidden_from(far)).read<float>(ELVIS_CHANNEL_COLOR) ==
          volume.render(shown).read<float>(ELVIS_CHANNEL_COLOR));
    CHECK(std::ranges::all_of(volume.render(shown, hidden_from(near)).read<float>(ELVIS_CHANNEL_COLOR),
                              [](float channel) { return channel == 0; }));
}

TEST_CASE("What hides light is refused with surfaces, with samples, without light, and where it is not a number") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    const std::vector<double> depths(40 * 30, 1.0), unknown(40 * 30, std::nan(""));
    CHECK_THROWS_WITH(volume.render(light(library, true), hidden_from(depths)), Catch::Contains("without surfaces"));
    scene smooth = light(library, false);
    smooth.set("/image/samples", "2");
    CHECK_THROWS_WITH(volume.render(smooth, hidden_from(depths)), Catch::Contains("samples"));
    scene dark = light(library, false);
    dark.remove("/volume_rendering");
    CHECK_THROWS_WITH(volume.render(dark, hidden_from(depths)), Catch::Contains("with volume rendering"));
    CHECK_THROWS_WITH(volume.render(light(library, false), hidden_from(unknown)), Catch::Contains("not a number"));
}
