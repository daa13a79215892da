// Volumes of runtime plugins in parts: of them records of elements are asked for.

#include "compared_pictures.hpp"
#include "parts_fixture.hpp"

#include <tests/support/error_of.hpp>

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace elvis;
using namespace elvis::test;

namespace {

constexpr Picture surfaces_with_lines{
    "plane and boundary",
    R"("surfaces": [{"type": "plane", "plane": [1, 0, 0, 0.1], "mesh_lines": {}, "contours": {"count": 5}},
                                           {"type": "boundary", "clip": [[-1, 0, 0, -0.1]]}])"};
constexpr Picture light{
    "light",
    R"("surfaces": [{"type": "plane", "plane": [1, 0.2, 0, 0.1]}], "volume_rendering": {"density": [[-2, 0], [2, 1]]})"};

std::string sample(const std::string& name) { return PLUGIN_FOLDER "/" + name; }

} // namespace

TEST_CASE("What plugins draw with their own functions is in parts what it is in the whole") {
    Stage dubiner(Stage::File{sample("dubiner_dg/samples/wavy_cube.ddg")});
    compare(dubiner, surfaces_with_lines, 3);
    compare(dubiner, light, 3);
    Stage nurbs(Stage::File{sample("nurbs/samples/pipe.nurbs")});
    compare(nurbs, {"NURBS", R"("surfaces": [{"type": "boundary", "mesh_lines": {}, "clip": [[1, 0, 0, 0]]}])"}, 4);
    Stage cut(Stage::File{sample("cut_cells/samples/ball.cut")});
    compare(cut, {"cut cells", R"("surfaces": [{"type": "plane", "plane": [1, 0, 0, 0.1], "mesh_lines": {}}])"}, 4);
    Stage lattice(Stage::File{sample("lattice/samples/tiny.txt")});
    compare(lattice, {"lattice", R"("surfaces": [{"type": "boundary"}])"}, 4);
}

TEST_CASE("Elements of a native volume that are chosen as a plugin's give the pictures of native parts") {
    const std::string mixed =
        R"({"generator": 1, "mesh": "waves", "shape": "mixed", "elements": [4, 2, 2], "order": 2, "field": "waves"})";
    Stage native(mixed), plugin(mixed, Precision::float32, Stage::Way::plugin);
    const Scene scene = native.scene(surfaces_with_lines.keys);
    const Frame a = native.in_parts(scene, 3), b = plugin.in_parts(plugin.scene(surfaces_with_lines.keys), 3);
    const auto is_same = [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); };
    CHECK(a.element == b.element);
    CHECK(a.flags == b.flags);
    CHECK(std::ranges::equal(a.value, b.value, is_same));
    CHECK(std::ranges::equal(a.depth, b.depth, is_same));
    CHECK(std::ranges::equal(a.normal, b.normal, is_same));
    CHECK(a.counts.hit_pixels > 1000);
}

TEST_CASE("A plugin that does not say that records belong to elements is not drawn in parts") {
    Stage analytic(Stage::File{sample("analytic/samples/twisted_box.txt")});
    const Scene scene = analytic.scene(R"("surfaces": [{"type": "boundary"}])");
    CHECK(error_of([&] { analytic.in_parts(scene, 2); }).find("does not say that records belong to elements") !=
          std::string::npos);
}
