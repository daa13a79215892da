// What stages of a picture leave out.
#include <core/render/frame_stage.hpp>

#include <catch2/catch.hpp>

using namespace elvis;
using Stage = FrameStage;

TEST_CASE("stages ask for less than the request, and the exact one for the request itself") {
    FrameRequest request;
    request.width = 1280;
    request.height = 720;
    Surface surface;
    surface.geometry = BoundaryFaces{};
    CHECK_FALSE(has_refinement(request));
    surface.mesh_lines = MeshLines{};
    request.surfaces = {surface};
    CHECK(has_refinement(request));
    request.camera.image_shift = {6, -3};
    request.volume.emplace();
    const FrameRequest moving = request_for(request, Stage::moving, 3);
    CHECK(moving.width == 427);
    CHECK(moving.height == 240);
    CHECK(moving.camera.image_shift == std::array<double, 2>{2, -1});
    CHECK(moving.surfaces[0].subdivisions < request.surfaces[0].subdivisions);
    CHECK(moving.volume->tolerance > request.volume->tolerance);
    CHECK(moving.surfaces[0].has_lines());
    CHECK_FALSE(request_for(request, Stage::moving, 3, false).surfaces[0].has_lines());
    const FrameRequest full = request_for(request, Stage::full, 1);
    CHECK(full.width == request.width);
    CHECK(full.volume->tolerance == moving.volume->tolerance);
    const FrameRequest exact = request_for(request, Stage::exact, 1);
    CHECK(exact.volume->tolerance == request.volume->tolerance);
    CHECK(exact.surfaces[0].subdivisions == request.surfaces[0].subdivisions);
    // Coarser wishes stay as they are.
    request.volume->tolerance = 0.1;
    request.surfaces[0].subdivisions = 1;
    CHECK_FALSE(has_refinement(request));
    CHECK(request_for(request, Stage::full, 1).volume->tolerance == 0.1);
    CHECK(request_for(request, Stage::full, 1).surfaces[0].subdivisions == 1);
}
