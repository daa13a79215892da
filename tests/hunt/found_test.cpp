// Scenes in which the hunt found silent errors.
#include "judge.hpp"

#include <tests/support/test_volumes.hpp>

#include <core/oracle/samples/exact_volumes.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <core/render/renderer.hpp>

#include <catch2/catch.hpp>

namespace elvis::hunt {

namespace {

/** An element of the unit cube between two y, the lower face of which is bent down far. */
oracle::Map bulge(double from, double to) {
    return [=](const oracle::Vector& xi) -> oracle::Vector {
        oracle::Vector x = 0.5 * (oracle::Vector::Ones() + xi);
        x.y() = from + (to - from) * x.y();
        x.z() -= 0.6 * (1 - xi.x() * xi.x()) * (1 - xi.y() * xi.y()) * (1 - xi.z());
        return x;
    };
}

Tally judge_cut(const std::vector<oracle::Map>& maps, double y, Precision precision) {
    const native::Space geometry = oracle::space_of(native::Shape::hexahedron, 2);
    oracle::VolumeData data;
    data.classes.push_back(
        oracle::make_class(geometry, geometry, maps, [](const oracle::Vector& x) { return x.x() + x.y() * x.z(); }));
    const TemporaryFile file("bulge.h5");
    oracle::write_volume(file.path(), data);
    const RuntimeVolume volume = oracle::open_volume(file.path());
    oracle::SceneVolume answers(file.path(), {});
    FrameRequest request;
    request.width = 120;
    request.height = 90;
    request.camera.eye = {0.7, 1.2, 3};
    request.camera.look_at = {0.47, 0.49, 0.35};
    request.camera.up = {0.94, -0.33, 0};
    request.camera.field_of_view = 29;
    Surface surface;
    surface.geometry = CutPlane{{0, 1, 0, -y}};
    surface.colors.points = {{-3, {0, 0.1, 0.9}}, {3, {1, 0.8, 0.1}}};
    surface.mesh_lines.emplace();
    request.surfaces = {surface};
    std::string reason;
    Judge judge(answers, request, reason);
    judge.draw();
    Renderer renderer(test::device(), volume, precision);
    return judge.judge(renderer.render(request), precision).tally;
}

} // namespace

TEST_CASE("A plane along faces of strongly bent elements shows their outline in each pixel") {
    // Far from where it is linearized, the mapping's error reaches over the whole element: a parallel face may lie in the
    // plane.
    const Precision precision = GENERATE(Precision::float32, Precision::float64);
    const auto check = [](const Tally& tally) {
        CHECK(tally.lines > 200);
        CHECK(tally.far + tally.near == 0);
        CHECK(tally.all_false_alarms == 0);
    };
    SECTION("between them") { check(judge_cut({bulge(0, 1)}, 0.65, precision)); }
    SECTION("in them") { check(judge_cut({bulge(0, 0.5), bulge(0.5, 1)}, 0.5, precision)); }
}

} // namespace elvis::hunt
