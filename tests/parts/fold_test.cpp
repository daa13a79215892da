// What is shown of pixels that several parts see.
#include <core/parts/fold_layers.hpp>
#include <core/parts/line_doubts.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <random>
#include <span>
#include <vector>

using namespace elvis;

namespace {

constexpr bool own = true, around = false;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

PartPixel seen(std::uint32_t pixel, std::int64_t element, double depth, bool is_own, std::uint32_t flags = 0) {
    PartPixel result;
    result.pixel = pixel;
    result.element = element;
    result.depth = depth;
    result.is_own = is_own ? 1 : 0;
    result.flags = flags;
    return result;
}

} // namespace

TEST_CASE("The nearest of what parts own is shown, and where they do not agree it is undecided") {
    FrameRequest request;
    request.width = 5;
    request.height = 1;
    request.surfaces.resize(1);
    std::vector<PartPixels> parts(2);
    parts[1].part = 1;
    parts[0].pixels = {seen(0, 1, 2, own), seen(1, 1, 2, own), seen(2, 7, 1, around), seen(3, 1, 1, own),
                       seen(4, -1, nothing, around, pixel_flag::isosurface_undecided)};
    // In the fourth pixel both see one surface; their depths are rounded.
    parts[1].pixels = {seen(0, 5, 1, own), seen(1, 2, 1, around), seen(3, 1, 1 - 1e-7, around), seen(4, 6, 1, own)};
    const PixelBlock all{0, 0, 5, 1};
    const Frame frame = folded(request, all, all, parts, 1, Precision::float64);
    CHECK(frame.element == std::vector<std::int64_t>{5, 2, 7, 1, 6});
    CHECK(frame.flags ==
          std::vector<std::uint32_t>{0, pixel_flag::undecided, pixel_flag::undecided, 0, pixel_flag::isosurface_undecided});
    CHECK(frame.depth[1] == 1);
}

TEST_CASE("Layers are all that parts own, each crossing once") {
    std::vector<PartPixels> parts(2);
    parts[1].part = 1;
    const double near = 1 + 1e-6;
    // Both see both, and own one each. Both own what is one crossing, of elements that share a face. None owns what both see.
    parts[0].pixels = {seen(0, 1, 2, own), seen(0, 5, 3, around), seen(1, 1, 1, own), seen(2, 6, 1, around)};
    parts[1].pixels = {seen(0, 1, 2, around), seen(0, 5, 3, own), seen(1, 5, near, own), seen(2, 1, near, around)};
    // Two crossings as near as that, of which the first part sees both.
    parts[0].pixels.push_back(seen(3, 1, 1, own));
    parts[0].pixels.push_back(seen(3, 5, near, around));
    parts[1].pixels.push_back(seen(3, 5, near, own));
    parts[1].pixels.push_back(seen(4, -1, nothing, around, pixel_flag::isosurface_undecided));
    FrameRequest request;
    request.width = 5;
    request.height = 1;
    request.surfaces.resize(1);
    const PixelBlock all{0, 0, 5, 1};
    const FoldedLayers folded = folded_layers(request, all, all, parts, 1);
    std::vector<std::array<std::int64_t, 3>> found;
    for (const PartPixel& crossing : folded.crossings) {
        found.push_back({crossing.pixel, crossing.element, crossing.flags});
    }
    CHECK(found ==
          std::vector<std::array<std::int64_t, 3>>{
              {0, 1, 0}, {0, 5, 0}, {1, 1, pixel_flag::undecided}, {2, 6, pixel_flag::undecided}, {3, 1, 0}, {3, 5, 0}});
    CHECK(folded.doubts == std::vector<std::uint32_t>{0, 0, 0, 0, pixel_flag::isosurface_undecided});
}

TEST_CASE("Layers are mixed from the farthest to the nearest, in front of what is opaque") {
    FrameRequest request;
    request.background = {0, 0, 1, 1};
    Frame picture = empty_block(request, {0, 0, 2, 1}, Precision::float64);
    picture.depth[1] = 2.5;
    picture.element[1] = 9;
    LayerStack stack(picture);
    FoldedLayers layers;
    layers.doubts.resize(2);
    for (const std::uint32_t pixel : {0u, 1u}) {
        layers.crossings.push_back(seen(pixel, 1, 2, own));
        layers.crossings.back().color = {1, 0, 0, 0.5};
        layers.crossings.push_back(seen(pixel, 2, 3, own, pixel_flag::undecided));
        layers.crossings.back().color = {0, 1, 0, 0.5};
    }
    stack.add(layers, picture);
    stack.blend(picture);
    finish_surfaces(picture);
    CHECK(picture.color == std::vector<double>{0.5, 0.25, 0.25, 1, 0.5, 0, 0.5, 1});
    CHECK(picture.element == std::vector<std::int64_t>{1, 1});
    CHECK(picture.depth == std::vector<double>{2, 2});
    // What is seen through the nearest stays in doubt.
    CHECK((picture.flags[0] & pixel_flag::undecided) != 0);
}

namespace {

/** All pixels of a part that owns every second stripe of four columns; in few of the others it sees another element. */
PartPixels striped_pixels(std::uint32_t part, std::uint32_t n_pixels, std::uint32_t width, std::mt19937& random) {
    PartPixels all{part, {}};
    for (std::uint32_t pixel = 0; pixel < n_pixels; ++pixel) {
        const bool is_own = pixel % width / 4 % 2 == part;
        all.pixels.push_back(seen(pixel, !is_own && random() % 100 == 0 ? 1 : 0, 1, is_own));
    }
    return all;
}

/** Of what the parts show, what lies in a block, as the block counts it. */
std::vector<PartPixels> pixels_in(const std::vector<PartPixels>& parts, const PixelBlock& block, std::uint32_t width) {
    std::vector<PartPixels> inside;
    for (const PartPixels& part : parts) {
        PartPixels& some = inside.emplace_back(PartPixels{part.part, {}});
        for (PartPixel pixel : part.pixels) {
            const std::uint32_t column = pixel.pixel % width, row = pixel.pixel / width;
            if (column >= block.first_column && column < block.first_column + block.width && row >= block.first_row &&
                row < block.first_row + block.height) {
                pixel.pixel = block.local(pixel.pixel, width);
                some.pixels.push_back(pixel);
            }
        }
    }
    return inside;
}

} // namespace

TEST_CASE("Tiles are put together to what the whole picture is, near lines, too") {
    FrameRequest request;
    request.width = 60;
    request.height = 40;
    request.camera.eye = {0, 0, 5};
    request.camera.up = {0, 1, 0};
    request.surfaces.resize(1);
    request.surfaces[0].contours.emplace();
    request.surfaces[0].contours->style.width = 3;
    std::mt19937 random(5);
    const std::vector<PartPixels> parts{striped_pixels(0, 2400, request.width, random),
                                        striped_pixels(1, 2400, request.width, random)};
    const PixelBlock all{0, 0, request.width, request.height};
    const Frame whole = folded(request, all, all, parts, 1, Precision::float64);
    const std::uint32_t reach = reach_of_fold(request);
    const TileShares shares(request.width, request.height, 4, reach);
    REQUIRE(shares.n_tiles() > 2);
    std::size_t n_open = 0;
    for (std::uint32_t tile = 0; tile < shares.n_tiles(); ++tile) {
        const PixelBlock own = shares.block(tile), block = shares.block(tile, reach);
        const Frame part = folded(request, block, own, pixels_in(parts, block, request.width), 1, Precision::float64);
        REQUIRE(part.flags.size() == own.n_pixels());
        for (std::uint32_t row = 0; row < own.height; ++row) {
            const std::size_t here = std::size_t{row} * own.width;
            const std::size_t there = std::size_t{own.first_row + row} * request.width + own.first_column;
            CHECK(std::equal(&part.flags[here], &part.flags[here] + own.width, &whole.flags[there]));
            CHECK(std::equal(&part.element[here], &part.element[here] + own.width, &whole.element[there]));
            n_open += static_cast<std::size_t>(
                std::ranges::count_if(std::span(part.flags).subspan(here, own.width),
                                      [](std::uint32_t flags) { return (flags & pixel_flag::contour_undecided) != 0; }));
        }
    }
    CHECK(n_open > 100);
    CHECK(n_open < 1200);
}
