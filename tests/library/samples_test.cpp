// Pictures whose pixels are means of several, and what that leaves as it is.

#include "some_volume.hpp"

#include <algorithm>
#include <cmath>

using namespace elvis;
using test::convert;
using test::own_plugins;
using test::TemporaryFolder;

namespace {

constexpr std::size_t width = 37, height = 29, n = 3;

/** Of n by n pixels, by how opaque they are. */
std::vector<double> means(const std::vector<double>& fine) {
    std::vector<double> colors(4 * width * height);
    for (std::size_t row = 0; row < n * height; ++row) {
        for (std::size_t column = 0; column < n * width; ++column) {
            const double* const from = &fine[4 * (row * n * width + column)];
            double* const to = &colors[4 * (row / n * width + column / n)];
            for (std::size_t channel = 0; channel < 3; ++channel) {
                to[channel] += from[3] * from[channel] / (n * n);
            }
            to[3] += from[3] / (n * n);
        }
    }
    for (std::size_t pixel = 0; pixel < colors.size(); pixel += 4) {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            colors[pixel + channel] /= colors[pixel + 3] > 0 ? colors[pixel + 3] : 1;
        }
    }
    return colors;
}

} // namespace

TEST_CASE("With samples a pixel's colour is the mean of those of the finer picture, and buffers are those without") {
    const context library(own_plugins());
    const TemporaryFolder folder;
    const data volume = library.open(convert(library, folder));
    for (const char* const surface : {R"({"type": "plane", "plane": [0, 0.2, 1, -0.4]})", R"({"type": "boundary"})",
                                      R"({"type": "isosurface", "values": [0.4]})"}) {
        INFO(surface);
        scene shown = library.make_scene();
        shown.set("/image/size", "[37, 29]");
        shown.set("/image/background", "[0.3, 0.5, 0.7, 0]");
        shown.set("/surfaces/-", surface);
        shown.set("/camera", R"({"eye": [3, 2, 2.5], "look_at": [0.5, 0.5, 0.5], "up": [0, 0, 1], "image_shift": [1, -2]})");
        const picture plain = volume.render(shown);
        scene finer = shown.copy();
        finer.set("/image/size", "[111, 87]");
        finer.set("/camera/image_shift", "[3, -6]");
        const std::vector<double> expected = means(volume.render(finer).read<double>(ELVIS_CHANNEL_COLOR));
        shown.set("/image/samples", "3");
        const picture smooth = volume.render(shown);
        const std::vector<double> colors = smooth.read<double>(ELVIS_CHANNEL_COLOR);
        REQUIRE(colors.size() == expected.size());
        double largest = 0;
        for (std::size_t i = 0; i < colors.size(); ++i) {
            largest = std::max(largest, std::abs(colors[i] - expected[i]));
        }
        CHECK(largest < 1e-12);
        CHECK(colors != plain.read<double>(ELVIS_CHANNEL_COLOR));
        CHECK(smooth.read<std::uint32_t>(ELVIS_CHANNEL_FLAGS) == plain.read<std::uint32_t>(ELVIS_CHANNEL_FLAGS));
        CHECK(smooth.read<std::int64_t>(ELVIS_CHANNEL_ELEMENT) == plain.read<std::int64_t>(ELVIS_CHANNEL_ELEMENT));
        CHECK(smooth.info().n_undecided_pixels == plain.info().n_undecided_pixels);
        CHECK_THROWS_WITH(shown.set("/image/samples", "9"), Catch::Contains("samples"));
    }
}
