// Pictures in parts against those of the whole volume.

#include "compared_pictures.hpp"
#include "parts_fixture.hpp"

#include <core/arrows/scene_arrows.hpp>
#include <core/session/streamline_tubes.hpp>
#include <core/session/supersampled.hpp>
#include <core/session/volume/describe_volume.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <span>

using namespace elvis;
using namespace elvis::test;

namespace {

constexpr Picture surfaces[] = {
    {"oblique plane", R"("surfaces": [{"type": "plane", "plane": [0.3, 0.25, 1, 0.05]}])"},
    {"boundary", R"("surfaces": [{"type": "boundary"}])"},
    {"isosurface", R"("surfaces": [{"type": "isosurface", "values": [0.3]}], "lighting": "default")"},
    {"all, clipped",
     R"("surfaces": [{"type": "plane", "plane": [1, 0, 0, 0.1]}, {"type": "isosurface", "values": [0.3]},
                     {"type": "boundary", "clip": [[-1, 0, 0, -0.1]]}])"},
};

} // namespace

TEST_CASE("Surfaces in parts are those of the whole: hexahedra") {
    Stage stage(R"({"generator": 1, "mesh": "waves", "elements": [5, 4, 4], "order": 3, "field": "waves"})");
    for (const Picture& picture : surfaces) {
        compare(stage, picture, 3);
    }
    compare(stage, surfaces[3], 7);
}

TEST_CASE("Surfaces in parts are those of the whole: a mixed mesh") {
    Stage stage(R"({"generator": 1, "mesh": "waves", "shape": "mixed", "elements": [4, 2, 2], "order": 2, "field": "waves"})");
    compare(stage, surfaces[3], 3);
}

TEST_CASE("Several samples a pixel in parts are those of the whole, in however many bands") {
    Stage stage(R"({"generator": 1, "mesh": "waves", "elements": [5, 4, 4], "order": 3, "field": "waves"})");
    const Scene scene = stage.scene(
        R"("image": {"size": [80, 60], "samples": 3}, "lighting": "default", "contours": {"count": 5}, "volume_rendering": {},
           "surfaces": [{"type": "plane", "plane": [0.3, 0.25, 1, 0.05]}, {"type": "isosurface", "values": [0.3]}])");
    Scene plain = scene;
    plain.samples = 1;
    const Frame whole = stage.as_whole(scene), parts = stage.in_parts(scene, 3), bands = stage.in_parts(scene, 3, 240 * 48);
    const Frame without_samples = stage.in_parts(plain, 3);
    const Differences found = between(whole, parts), without = between(stage.as_whole(plain), parts);
    std::printf("3 x 3 samples: colour is off in %zu of %zu pixels (%zu unflagged), and in %zu if there is one sample\n",
                found.n_color, found.n_hit, found.n_silent, without.n_color);
    CHECK(bands.color == parts.color);
    CHECK(bands.flags == parts.flags);
    CHECK(found.n_silent == 0);
    CHECK(found.n_color <= found.n_hit / 100);
    CHECK(parts.counts.undecided_contour_pixels ==
          static_cast<std::size_t>(std::ranges::count_if(
              parts.flags, [](std::uint32_t flags) { return (flags & pixel_flag::contour_undecided) != 0; })));
    CHECK(without.n_color > 500);
    CHECK(parts.counts.undecided_contour_pixels + parts.counts.undecided_pixels >
          without_samples.counts.undecided_contour_pixels + without_samples.counts.undecided_pixels);
}

TEST_CASE("A pixel has the doubt of its samples, and is counted once") {
    // Two by two samples of the second of two rows.
    Frame frame, fine;
    frame.width = 3;
    frame.height = 2;
    frame.flags = {0, 0, 0, 0, pixel_flag::undecided, 0};
    frame.counts.undecided_pixels = 1;
    fine.width = 6;
    fine.height = 2;
    fine.flags = {0,
                  pixel_flag::contour,
                  pixel_flag::undecided,
                  0,
                  0,
                  pixel_flag::contour_undecided,
                  0,
                  0,
                  0,
                  0,
                  pixel_flag::contour_undecided | pixel_flag::undecided,
                  0};
    take_doubts(fine, {2, 4}, 2, frame);
    CHECK(frame.flags ==
          std::vector<std::uint32_t>{0, 0, 0, 0, pixel_flag::undecided, pixel_flag::undecided | pixel_flag::contour_undecided});
    CHECK(frame.counts.undecided_pixels == 2);
    CHECK(frame.counts.undecided_contour_pixels == 1);
}

TEST_CASE("Wide lines in parts are those of the whole, or flagged, and refused on what is cut away") {
    Stage stage(R"({"generator": 1, "mesh": "waves", "elements": [5, 4, 4], "order": 3, "field": "waves"})");
    const std::string lines = R"("image": {"size": [240, 180]}, "contours": {"count": 5, "width": 3}, "surfaces": [)";
    const Scene scene = stage.scene(lines + R"({"type": "plane", "plane": [0.3, 0.25, 1, 0.05]}, {"type": "boundary"}])");
    compare({"wide lines", ""}, 3, stage.as_whole(scene), stage.in_parts(scene, 3));
    const Scene cut = stage.scene(lines + R"({"type": "boundary", "clip": [[-1, 0, 0, -0.1]]}])");
    CHECK_THROWS_WITH(stage.in_parts(cut, 3), Catch::Contains("lines of several pixels"));
}

TEST_CASE("A plane in faces between parts shows the viewer's side") {
    // Layers of elements, each of which is a part, and a field that jumps between elements.
    Stage stage(R"({"generator": 1, "mesh": "box", "elements": [4, 4, 4], "field": "element"})");
    compare(stage, {"plane in faces between parts", R"("surfaces": [{"type": "plane", "plane": [0, 0, 1, 0]}])"}, 4);
    compare(
        stage,
        {"the same from below",
         R"("surfaces": [{"type": "plane", "plane": [0, 0, 1, 0]}], "camera": {"eye": [0.3, 0.2, -4], "look_at": [0, 0, 0]})"},
        4);
    // Where the field is continuous nothing is open, as in the whole.
    Stage smooth(R"({"generator": 1, "mesh": "box", "elements": [4, 4, 4], "field": "waves", "order": 2})");
    const Scene scene = smooth.scene(R"("surfaces": [{"type": "plane", "plane": [0, 0, 1, 0]}])");
    const Frame whole = smooth.as_whole(scene), parts = smooth.in_parts(scene, 4);
    CHECK(parts.counts.undecided_pixels == whole.counts.undecided_pixels);
    CHECK(parts.element == whole.element);
    CHECK(parts.color == whole.color);
}

TEST_CASE("Lines in parts are those of the whole, or flagged") {
    Stage stage(R"({"generator": 1, "mesh": "waves", "elements": 4, "order": 3, "field": "waves"})");
    compare(
        stage,
        {"contours and mesh lines",
         R"("surfaces": [{"type": "plane", "plane": [0.3, 0.25, 1, 0.05]}], "contours": {"values": [-0.5, 0, 0.5]}, "mesh_lines": {})"},
        4);
    compare(
        stage,
        {"mesh lines of two planes",
         R"("surfaces": [{"type": "plane", "plane": [0.3, 0.25, 1, 0.05]}, {"type": "plane", "plane": [1, 0, 0, 0]}], "mesh_lines": {})"},
        4);
    compare(stage,
            {"wide ones on the boundary",
             R"("surfaces": [{"type": "boundary"}], "contours": {"values": [0], "width": 5}, "mesh_lines": {"width": 3})"},
            4);
}

TEST_CASE("Thresholds in parts are those of the whole") {
    Stage stage(R"({"generator": 1, "mesh": "waves", "elements": [5, 4, 4], "order": 3, "field": "waves"})");
    compare(stage, {"a threshold alone", R"("threshold": "waves > 0.1 && x < 0.4")"}, 3);
    compare(stage,
            {"a threshold of other surfaces",
             R"("threshold": "waves > 0.1", "surfaces": [{"type": "plane", "plane": [0.3, 0.25, 1, 0.05]}, {"type": "boundary"},
                {"type": "isosurface", "field": "x^2 + y^2 + z^2", "values": [0.7]}], "lighting": "default")"},
            4);
}

TEST_CASE("Surfaces that can be seen through are in parts those of the whole") {
    const Picture pictures[] = {
        {"isosurfaces",
         R"("surfaces": [{"type": "isosurface", "values": [-0.3, 0.3], "opacity": 0.4}], "lighting": "default")"},
        {"boundary before a plane", R"("surfaces": [{"type": "plane", "plane": [0.3, 0.25, 1, 0.05]},
                                                  {"type": "boundary", "opacity": 0.3}])"},
        {"all, clipped", R"("surfaces": [{"type": "plane", "plane": [1, 0, 0, 0.1], "opacity": 0.5},
                                        {"type": "boundary", "clip": [[-1, 0, 0, -0.1]]},
                                        {"type": "isosurface", "values": [0.3], "opacity": 0.7, "clip": [[0, 1, 0, 0.1]]},
                                        {"type": "boundary", "opacity": 0.2}])"},
        {"lines on planes",
         R"("surfaces": [{"type": "plane", "plane": [0.3, 0.25, 1, 0.05], "opacity": 0.5, "contours": {"count": 5},
                                            "mesh_lines": {}},
                                           {"type": "plane", "plane": [1, 0, 0, 0.1], "opacity": 0.5, "mesh_lines": {"width": 3}},
                                           {"type": "wireframe", "opacity": 0.5}])"},
        {"lines on curved surfaces",
         R"("surfaces": [{"type": "boundary", "opacity": 0.5, "contours": {"count": 4}, "mesh_lines": {}},
                         {"type": "sphere", "center": [0, 0, 0], "radius": 0.7, "opacity": 0.6, "outside": [1, 0.9, 0.2],
                          "contours": {"count": 4}, "mesh_lines": {}}])"},
        {"wide lines on the boundary", R"("surfaces": [{"type": "boundary", "opacity": 0.5, "mesh_lines": {"width": 3}}])"},
    };
    Stage hexahedra(R"({"generator": 1, "mesh": "waves", "elements": [5, 4, 4], "order": 3, "field": "waves"})");
    Stage mixed(R"({"generator": 1, "mesh": "ball", "shape": "mixed", "elements": [2, 2, 2], "geometry_order": 2, "order": 3,
                    "field": "waves"})");
    for (const Picture& picture : std::span(pictures).first(5)) {
        compare(hexahedra, picture, 5);
    }
    compare(hexahedra, pictures[5], 2);
    for (const Picture& picture : std::span(pictures).subspan(2, 2)) {
        compare(mixed, picture, 3);
    }
}

TEST_CASE("Where surfaces lie in no element they have in parts the colour that they have in the whole") {
    const Picture pictures[] = {
        {"plane with lines", R"("surfaces": [{"type": "plane", "plane": [0.3, 0.25, 1, 0.05], "outside": [1, 0.9, 0.2],
                                             "contours": {"count": 5}, "mesh_lines": {}}])"},
        {"sphere before the boundary", R"("surfaces": [{"type": "sphere", "center": [1, 0, 0], "radius": 0.6,
                                                      "outside": [0.2, 0.9, 0.9]}, {"type": "boundary"}], "lighting": "default")"},
        {"both seen through", R"("surfaces": [{"type": "sphere", "center": [1, 0, 0], "radius": 0.6, "opacity": 0.4,
                                              "outside": [0.2, 0.9, 0.9]},
                                             {"type": "plane", "plane": [0.3, 0.25, 1, 0.05], "outside": [1, 0.9, 0.2],
                                              "opacity": 0.6, "mesh_lines": {}}])"},
    };
    Stage stage(R"({"generator": 1, "mesh": "waves", "elements": [5, 4, 4], "order": 3, "field": "waves"})");
    for (const Picture& picture : pictures) {
        compare(stage, picture, 2);
        compare(stage, picture, 5);
    }
    const Scene scene = stage.scene(pictures[0].keys);
    const Frame whole = stage.as_whole(scene), parts = stage.in_parts(scene, 5);
    CHECK(parts.counts.hit_pixels == whole.counts.hit_pixels);
    const auto n_outside = std::ranges::count_if(whole.element, [](std::int64_t number) { return number < 0; });
    CHECK(n_outside > 1000);
}

TEST_CASE("Faces of chosen elements, and their edges, are in parts those of the whole") {
    const Picture pictures[] = {
        {"all faces", R"("surfaces": [{"type": "elements", "ids": [[0, 9], 30, [41, 60]]}])"},
        {"outer faces by value", R"("surfaces": [{"type": "elements", "value_range": [0.4, 2], "faces": "outer"}])"},
        {"inner faces", R"("surfaces": [{"type": "elements", "faces": "inner", "clip": [[0, 0, -1, 0.1]]}])"},
        {"edges", R"("surfaces": [{"type": "wireframe", "ids": [[5, 25], 40], "faces": "outer"}])"},
        {"seen through", R"("surfaces": [{"type": "elements", "ids": [[10, 50]], "faces": "outer", "opacity": 0.5}])"},
    };
    Stage stage(R"({"generator": 1, "mesh": "waves", "elements": [5, 4, 4], "order": 3, "field": "waves"})");
    for (const Picture& picture : pictures) {
        compare(stage, picture, 2);
        compare(stage, picture, 5);
    }
}

TEST_CASE("Arrows, streamlines and pathlines in parts are those of the whole") {
    Stage stage(
        R"({"generator": 1, "mesh": "box", "elements": [4, 3, 3], "order": 3, "fields": ["taylor-green"], "time_steps": 3})");
    const char* const boundary = R"({"type": "boundary", "name": "wall", "clip": [[0, 0, -1, -0.2]]})";
    const auto with = [&](const std::string& more) { return std::string(R"("surfaces": [)") + boundary + ", " + more + "]"; };
    for (const auto& [name, keys] :
         {std::pair{"arrows on the boundary", with(R"({"type": "arrows", "vectors": "velocity", "on": "wall", "scale": 0.3})")},
          std::pair{"arrows in the volume", with(R"({"type": "arrows", "vectors": "velocity", "field": "pressure"})")},
          std::pair{"streamlines", with(R"({"type": "streamlines", "flow": "velocity", "radius": 0.03, "seed_grid": 3})")},
          std::pair{"ribbons", with(R"({"type": "streamlines", "flow": "velocity", "ribbon_width": 0.1, "seed_grid": 3})")},
          std::pair{"pathlines", with(R"({"type": "pathlines", "flow": "velocity", "radius": 0.03, "seed_grid": 3})")}}) {
        const Scene scene = stage.scene(keys);
        Scene whole = scene;
        StreamlineTubes tubes;
        SceneArrowSets arrows;
        const TaskControl control;
        const std::array<double, 6> bounds = bounds_of(stage.volume()).first;
        tubes.provide(whole, stage.volume(), bounds, control);
        arrows.provide(whole, stage.volume(), bounds, control);
        compare({name, keys.c_str()}, 3, stage.as_whole(whole), stage.in_parts(scene, 3));
    }
}

TEST_CASE("Streaks in parts are those of the whole") {
    Stage stage(R"({"generator": 1, "mesh": "waves", "elements": [5, 4, 4], "order": 3, "field": "waves"})");
    const std::string lic =
        R"s(, "lighting": "default", "lic": {"length": 12, "field": "y*grad(x) - x*grad(y) + 0.5*grad(z)"})s";
    const std::string plane = R"({"type": "plane", "plane": [0.3, 0.25, 1, 0.05]})";
    const std::string isosurface = R"({"type": "isosurface", "values": [0.3]})";
    for (const auto& [name, shown] :
         {std::pair{"streaks on a plane", plane}, std::pair{"streaks on the boundary", std::string(R"({"type": "boundary"})")},
          std::pair{"streaks on an isosurface", isosurface}, std::pair{"streaks on two surfaces", plane + ", " + isosurface}}) {
        const std::string keys = "\"surfaces\": [" + shown + "]" + lic;
        compare(stage, {name, keys.c_str()}, 4);
    }
}

TEST_CASE("Edges of the boundary in parts are those of the whole") {
    Stage stage(R"({"generator": 1, "mesh": "waves", "shape": "mixed", "elements": [4, 2, 2], "order": 2, "field": "waves"})");
    compare(stage, {"edges", R"("surfaces": [{"type": "wireframe"}])"}, 4);
    compare(
        stage,
        {"wide edges behind a plane",
         R"("surfaces": [{"type": "plane", "plane": [0.3, 0.25, 1, 0.05]}, {"type": "wireframe", "width": 3, "color": [1, 0, 0]}])"},
        5);
}

TEST_CASE("Parts without elements change nothing") {
    Stage stage(R"({"generator": 1, "mesh": "box", "elements": 2, "field": "sphere"})");
    const Scene scene = stage.scene(R"("surfaces": [{"type": "boundary"}])");
    const Frame eight = stage.in_parts(scene, 8), twenty = stage.in_parts(scene, 20);
    CHECK(eight.color == twenty.color);
    CHECK(eight.element == twenty.element);
    CHECK(eight.flags == twenty.flags);
}

TEST_CASE("Ragged and interleaved parts, one of them without elements, are those of the whole") {
    Stage stage(R"({"generator": 1, "mesh": "waves", "elements": [4, 3, 3], "order": 2, "field": "waves"})");
    const std::uint64_t n = stage.volume().n_elements();
    std::mt19937 random(3);
    for (const bool is_ragged : {true, false}) {
        // Either every element by chance, or one after the other; part 2 of 5 has none.
        std::vector<std::vector<Span>> parts(5);
        for (std::uint64_t element = 0; element < n; ++element) {
            const std::uint64_t one = (is_ragged ? random() : element) % 4;
            parts[one < 2 ? one : one + 1].push_back({element, element + 1});
        }
        const std::unique_ptr<VolumeInParts> drawn = stage.open_parts(Partition(std::move(parts)));
        for (const Picture& picture : {surfaces[3], Picture{"the volume itself", R"("volume_rendering": {})"}}) {
            const Scene scene = stage.scene(picture.keys);
            compare({is_ragged ? "ragged" : "interleaved", picture.keys}, 5, stage.as_whole(scene),
                    drawn->draw(scene).still.frame);
        }
    }
}

TEST_CASE("Volume rendering in parts is that of the whole") {
    Stage stage(R"({"generator": 1, "mesh": "waves", "elements": [4, 3, 3], "order": 3, "field": "waves"})");
    constexpr const char* density = R"("volume_rendering": {"density": [[-2, 0], [-0.5, 0.2], [0.5, 0.6], [2, 3]]})";
    compare(stage, {"the volume itself", density}, 4);
    const std::string before = std::string(density) + R"(, "surfaces": [{"type": "plane", "plane": [1, 0.2, 0, 0.1]}])";
    compare(stage, {"in front of a plane", before.c_str()}, 4);
    const std::string within = std::string(density) + R"(, "camera": {"eye": [0.1, 0.05, 0.02], "look_at": [1, 0.2, 0.3]})";
    compare(stage, {"with the eye inside", within.c_str()}, 3);
}

TEST_CASE("Light of the volume between surfaces that can be seen through is in parts that of the whole") {
    const Picture pictures[] = {
        {"isosurfaces in the volume",
         R"("surfaces": [{"type": "isosurface", "values": [-0.3, 0.3], "opacity": 0.4}], "lighting": "default",
                                         "volume_rendering": {"density": [[-2, 0], [-0.5, 0.2], [0.5, 0.6], [2, 3]]})"},
        {"boundary around it, a plane in it",
         R"("surfaces": [{"type": "boundary", "opacity": 0.3}, {"type": "plane", "plane": [1, 0.2, 0, 0.1], "opacity": 0.5, "mesh_lines": {}},
                         {"type": "boundary", "clip": [[0, 0, -1, 0.3]]}], "volume_rendering": {"density": [[-2, 0], [2, 2]]})"},
        {"the eye inside", R"("surfaces": [{"type": "sphere", "center": [0, 0, 0], "radius": 0.5, "opacity": 0.5}],
                              "volume_rendering": {"density": [[-2, 0], [2, 2]]},
                              "camera": {"eye": [0.1, 0.05, 0.02], "look_at": [1, 0.2, 0.3]})"},
    };
    Stage hexahedra(R"({"generator": 1, "mesh": "waves", "elements": [4, 3, 3], "order": 3, "field": "waves"})");
    Stage mixed(R"({"generator": 1, "mesh": "ball", "shape": "mixed", "elements": [2, 2, 2], "geometry_order": 2, "order": 3,
                    "field": "waves"})");
    compare(hexahedra, pictures[0], 4);
    compare(mixed, pictures[1], 3);
    compare(hexahedra, pictures[2], 4);
}

TEST_CASE("Camera, ranges and expressions in parts are those of the whole") {
    Stage stage(R"({"generator": 1, "mesh": "ball", "elements": 2, "layers": 2, "order": 4, "field": "sinc"})");
    // Nothing is said but the field: all else is found out by the parts together.
    compare(stage, {"default view of an expression", R"~("field": "x * sinc + d(sinc, y)")~"}, 4);
    compare(stage, {"default view of a field", R"("field": "sinc")"}, 4);
}

TEST_CASE("Parts in double precision") {
    Stage stage(R"({"generator": 1, "mesh": "waves", "elements": 3, "order": 2, "field": "waves"})", Precision::float64);
    compare(stage, surfaces[0], 3);
}
