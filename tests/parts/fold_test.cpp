// What is shown of pixels that several parts see.
#include <core/parts/fold.hpp>

#include <catch2/catch.hpp>

using namespace elvis;

namespace {

constexpr bool own = true, around = false;

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

TEST_CASE("The nearest of what parts own is shown; where they do not agree it is undecided") {
    FrameRequest request;
    request.width = 5;
    request.height = 1;
    request.surfaces.resize(1);
    std::vector<PartPixels> parts(2);
    parts[1].part = 1;
    parts[0].pixels = {seen(0, 1, 2, own), seen(1, 1, 2, own), seen(2, 7, 1, around), seen(3, 1, 1, own),
                       seen(4, -1, 0, around, pixel_flag::isosurface_undecided)};
    // In the fourth pixel both see one surface; their depths are rounded.
    parts[1].pixels = {seen(0, 5, 1, own), seen(1, 2, 1, around), seen(3, 1, 1 - 1e-7, around), seen(4, 6, 1, own)};
    const PixelBlock all{0, 0, 5, 1};
    const Frame frame = folded(request, all, all, parts, 1, Precision::float64);
    CHECK(frame.element == std::vector<std::int64_t>{5, 2, 7, 1, 6});
    CHECK(frame.flags ==
          std::vector<std::uint32_t>{0, pixel_flag::undecided, pixel_flag::undecided, 0, pixel_flag::isosurface_undecided});
    CHECK(frame.depth[1] == 1);
}
