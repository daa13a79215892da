// From a scene's volume rendering to what the renderer is asked for.

#include "fixture.hpp"
#include "stage.hpp"

#include <core/scene/color/transfer.hpp>
#include <core/scene/scene_annotation.hpp>

#include <cmath>

using namespace elvis;
using namespace elvis::test;
using Catch::Matchers::Contains;

TEST_CASE("A scene's volume rendering is asked of the renderer with everything decided") {
    Stage stage;
    const std::string first = stage.volume.fields()[0].name;
    SECTION("by default") {
        const FrameRequest request = stage.request(R"("volume_rendering": {})");
        REQUIRE(request.volume);
        CHECK(request.surfaces.empty());
        CHECK(request.volume->integrator == Integrator::exact);
        CHECK(request.volume->step == Approx(stage.diagonal() / 256));
        CHECK(request.volume->tolerance == 0.001);
        CHECK(request.volume->skips_by_range);
        const FieldRange range = stage.renderer.ranges().extrema(request.volume->field, 0).range();
        const TransferFunction& transfer = request.volume->transfer;
        REQUIRE(transfer.density.size() == 2);
        CHECK(transfer.density[0].value == range.lower);
        CHECK(transfer.density[1].value == range.upper);
        CHECK(transfer.density[1].density == Approx(std::log(20) / stage.diagonal()));
        CHECK(transfer.color.front().value == range.lower);
        CHECK(transfer.color.back().value == range.upper);
    }
    SECTION("the camera sees all of the volume, as without") {
        const Camera with = stage.request(R"("volume_rendering": {})").camera;
        const Camera without = stage.request(R"("surfaces": [{"type": "sphere", "center": [0, 0, 0], "radius": 1}])").camera;
        CHECK(with.eye == without.eye);
    }
    SECTION("without, there is none, and surfaces as ever") {
        const FrameRequest request = stage.request("");
        CHECK_FALSE(request.volume);
        CHECK(request.surfaces.size() == 1);
    }
    SECTION("beside surfaces") {
        const FrameRequest request =
            stage.request(R"("volume_rendering": {}, "surfaces": [{"type": "plane", "plane": [0, 0, 1, 0]}])");
        CHECK(request.volume);
        CHECK(request.surfaces.size() == 1);
    }
    SECTION("of a field of its own, with its own colours and steps") {
        const FrameRequest request = stage.request(
            R"("color_map": {"name": "gray", "range": [0, 1]},
               "volume_rendering": {"field": "x + 2 * y", "color_map": {"points": [[0, 1, 0, 0], [1, 0, 0, 1]], "range": [5, 6]},
                                    "density": [[0, 1], [9, 2]], "peaks": [{"value": 4, "width": 2, "density": 10}],
                                    "integrator": "riemann", "step": 0.25, "range_skipping": false})");
        REQUIRE(request.volume);
        CHECK(request.volume->field.expression);
        CHECK(request.volume->field_label == "x + 2 * y");
        CHECK(request.volume->integrator == Integrator::riemann);
        CHECK(request.volume->step == 0.25);
        CHECK_FALSE(request.volume->skips_by_range);
        const TransferFunction& transfer = request.volume->transfer;
        REQUIRE(transfer.color.size() == 2);
        CHECK((transfer.color[0].value == 5 && transfer.color[1].value == 6));
        CHECK(density_at(transfer, 4) == Approx(1 + 4.0 / 9 + 10));
        CHECK(density_at(transfer, 2.9) == Approx(1 + 2.9 / 9));
    }
    SECTION("of the scene's field, with the scene's colour map") {
        const FrameRequest request = stage.request(R"("field": "x", "color_map": {"name": "gray", "range": [3, 4]},
            "volume_rendering": {"opacity": [[3, 0.5]], "unit_distance": 2})");
        CHECK(request.volume->field.expression);
        CHECK(request.volume->transfer.color.front().value == 3);
        CHECK(request.volume->transfer.density.front().density == Approx(std::log(2) / 2));
    }
    SECTION("with distances to surfaces of the scene") {
        const FrameRequest request = stage.request(R"x("volume_rendering": {"field": "distance(ball)"},
            "surfaces": [{"type": "sphere", "name": "ball", "center": [0, 0, 0], "radius": 0.5}])x");
        CHECK(request.volume->field.expression);
        CHECK(request.volume->field_label == "distance(ball)");
    }
    SECTION("with an unknown field, or file") {
        CHECK_THAT(error_of([&] { stage.request(R"("volume_rendering": {"field": "nonsense"})"); }), Contains("nonsense"));
        CHECK_THAT(error_of([&] { stage.request(R"("volume_rendering": {"transfer": "nowhere.json"})"); }),
                   Contains("nowhere.json") && Contains("cannot be read"));
        CHECK_THAT(error_of([&] { stage.request(R"("volume_rendering": {"color_map": {"name": "nonsense"}})"); }),
                   Contains("viridis"));
    }
}

TEST_CASE("A colour bar shows the colours of the volume, once if a surface has the same") {
    Stage stage;
    const auto bars = [&](const std::string& keys) {
        const FrameRequest request = stage.request(keys);
        Frame frame;
        frame.special_values.resize(request.surfaces.size());
        return make_annotation_request({}, request, frame, stage.volume).color_bars;
    };
    const auto alone = bars(R"("volume_rendering": {"field": "x * y"})");
    REQUIRE(alone.size() == 1);
    CHECK(alone[0].name == "x * y");
    CHECK(alone[0].colors.points.size() > 2);
    for (const char* name : {"viridis", "gray", "coolwarm"}) {
        const std::string map = R"("color_map": {"name": ")" + std::string(name) + "\"}, ";
        CHECK(bars(map + R"("volume_rendering": {}, "surfaces": [{"type": "plane", "plane": [0, 0, 1, 0]}])").size() == 1);
    }
    CHECK(bars(R"("volume_rendering": {"color_map": {"name": "magma"}},
                  "surfaces": [{"type": "plane", "plane": [0, 0, 1, 0]}])")
              .size() == 2);
    CHECK(bars(R"("volume_rendering": {"field": "x"}, "surfaces": [{"type": "plane", "plane": [0, 0, 1, 0]}])").size() == 2);
    // One colour tells nothing.
    CHECK(bars(R"("volume_rendering": {"transfer": {"color": [[0, 1, 0, 0]], "density": [[0, 1]]}})").empty());
}
