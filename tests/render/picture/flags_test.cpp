// Flags of pixels and their counts, which the device settles.
#include <tests/support/test_volumes.hpp>

#include <core/oracle/samples/meshes.hpp>
#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace elvis::oracle {
namespace {

/** A sphere with lines that are looked for in quarters of pixels only, so that many stay open, and isosurfaces. */
FrameRequest lines_and_isosurface() {
    FrameRequest request;
    request.width = 90;
    request.height = 70;
    request.camera.eye = {2.1, -1.7, 1.3};
    request.camera.look_at = {0, 0, 0};
    request.camera.up = {0, 0, 1};
    request.camera.field_of_view = 45;
    Surface sphere, levels;
    sphere.geometry = Sphere{{0.1, 0, 0.2}, 0.7};
    sphere.colors.points = {{-1, {0, 0, 1}}, {1, {1, 0, 0}}};
    sphere.contours = Contours{{-0.9, -0.6, -0.3, 0, 0.3, 0.6, 0.9}, {1, std::array<double, 3>{0, 0, 0}, {}}};
    sphere.mesh_lines.emplace();
    sphere.subdivisions = 1;
    levels.geometry = Isosurfaces{.values = {-0.9, 0.9}};
    levels.colors = sphere.colors;
    request.surfaces = {sphere, levels};
    return request;
}

} // namespace

TEST_CASE("Pixels are counted by their flags, and what is decided is not undecided") {
    const TemporaryFile file("mixed.h5");
    generate(R"({"generator": 1, "mesh": "ball", "shape": "mixed", "elements": [2, 2, 2], "order": 3, "geometry_order": 2,)"
             R"( "field": "waves"})",
             file.path());
    const RuntimeVolume volume = open_volume(file.path());
    Renderer renderer(test::device(), volume, Precision::float32);
    const Frame frame = renderer.render(lines_and_isosurface());
    const auto count = [&](std::uint32_t flag) {
        return static_cast<std::uint64_t>(
            std::ranges::count_if(frame.flags, [flag](std::uint32_t flags) { return (flags & flag) == flag; }));
    };
    const FrameCounts& counts = frame.counts;
    CHECK(counts.hit_pixels ==
          static_cast<std::uint64_t>(std::ranges::count_if(frame.depth, [](double depth) { return !std::isnan(depth); })));
    CHECK(counts.contour_pixels == count(pixel_flag::contour));
    CHECK(counts.undecided_contour_pixels == count(pixel_flag::contour_undecided));
    CHECK(counts.mesh_line_pixels == count(pixel_flag::mesh_line));
    CHECK(counts.undecided_mesh_line_pixels == count(pixel_flag::mesh_line_undecided));
    CHECK(counts.isosurface_pixels == count(pixel_flag::isosurface));
    CHECK(counts.undecided_isosurface_pixels == count(pixel_flag::isosurface_undecided));
    CHECK(counts.undecided_pixels == count(pixel_flag::undecided));
    CHECK(counts.estimated_pixels == count(pixel_flag::estimated));
    for (const std::uint64_t some : {counts.hit_pixels, counts.contour_pixels, counts.undecided_contour_pixels,
                                     counts.mesh_line_pixels, counts.undecided_mesh_line_pixels, counts.isosurface_pixels})
        CHECK(some > 20);
    CHECK(count(pixel_flag::contour | pixel_flag::contour_undecided) == 0);
    CHECK(count(pixel_flag::mesh_line | pixel_flag::mesh_line_undecided) == 0);
    // Without buffers the flags are not read, and counted all the same.
    FrameRequest colors_alone = lines_and_isosurface();
    colors_alone.with_buffers = false;
    const Frame brief = renderer.render(colors_alone);
    CHECK(brief.flags.empty());
    CHECK(brief.counts.undecided_contour_pixels == counts.undecided_contour_pixels);
    CHECK(brief.counts.hit_pixels == counts.hit_pixels);
}

TEST_CASE("Open lines of a surface that is seen through a transparent one leave doubt, whatever comes first") {
    const TemporaryFile file("seen_through.h5");
    generate(R"({"generator": 1, "mesh": "ball", "shape": "mixed", "elements": [2, 2, 2], "order": 3, "geometry_order": 2,)"
             R"( "field": "waves"})",
             file.path());
    const RuntimeVolume volume = open_volume(file.path());
    Renderer renderer(test::device(), volume, Precision::float32);
    FrameRequest request = lines_and_isosurface();
    request.surfaces.pop_back();
    request.surfaces[0].geometry = Sphere{{0, 0, 0}, 0.45};
    const Frame alone = renderer.render(request);
    Surface glass;
    glass.geometry = CutPlane{{0.8, -0.6, 0.4, -0.6}};
    glass.opacity = 0.3;
    glass.colors = request.surfaces[0].colors;
    // Before an opaque surface, and before a transparent one that is drawn earlier or later.
    for (const auto& [opacity, is_first] : {std::pair(1.0, false), {0.9, false}, {0.9, true}}) {
        FrameRequest both = request;
        both.surfaces[0].opacity = opacity;
        both.surfaces.insert(is_first ? both.surfaces.begin() : both.surfaces.end(), glass);
        const Frame frame = renderer.render(both);
        std::size_t n_open = 0, n_silent = 0;
        for (std::size_t pixel = 0; pixel < alone.flags.size(); ++pixel) {
            const bool is_open = (alone.flags[pixel] & (pixel_flag::contour_undecided | pixel_flag::mesh_line_undecided)) != 0;
            if (is_open && frame.depth[pixel] < alone.depth[pixel] - 0.01) {
                ++n_open;
                n_silent += (frame.flags[pixel] & pixel_flag::undecided) == 0 ? 1 : 0;
                CHECK((frame.flags[pixel] & pixel_flag::contour_undecided) == 0);
            }
        }
        CHECK(n_open > 50);
        CHECK(n_silent == 0);
    }
}

} // namespace elvis::oracle
