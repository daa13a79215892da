// What a scene's threshold asks of the renderer.

#include "fixture.hpp"
#include "stage.hpp"

#include <core/scene/threshold.hpp>

using namespace elvis;
using namespace elvis::test;
using Catch::Matchers::Contains;

TEST_CASE("A threshold is the comparisons that it joins") {
    Stage stage;
    const std::string name = stage.volume.fields()[0].name;
    const auto conditions_of = [&](const std::string& text) { return threshold_conditions(text, {}, stage.volume); };
    SECTION("of a field with a number, as it is") {
        const auto conditions = conditions_of(name + " >= 2 * 0.25");
        REQUIRE(conditions.size() == 1);
        CHECK_FALSE(conditions[0].field.expression);
        CHECK((conditions[0].value == 0.5 && conditions[0].is_above && conditions[0].takes_equal));
    }
    SECTION("of a number with an expression, the other way round") {
        const auto conditions = conditions_of("-1 < x + " + name);
        REQUIRE(conditions.size() == 1);
        CHECK(conditions[0].field.expression);
        CHECK((conditions[0].value == -1 && conditions[0].is_above && !conditions[0].takes_equal));
    }
    SECTION("of two expressions, by their difference") {
        const auto conditions = conditions_of("(((x < y) && ((" + name + ") <= (z))))");
        REQUIRE(conditions.size() == 2);
        CHECK(conditions[0].field.expression->text() == "0 + (x) - (y)");
        CHECK((conditions[0].value == 0 && !conditions[0].is_above && !conditions[0].takes_equal));
        CHECK((conditions[1].value == 0 && !conditions[1].is_above && conditions[1].takes_equal));
    }
    SECTION("with distances to surfaces of the scene") {
        const FrameRequest request = stage.request(R"x("threshold": "distance(ball) > 0",
            "surfaces": [{"type": "sphere", "name": "ball", "center": [0, 0, 0], "radius": 0.5}])x");
        REQUIRE(request.surfaces[0].conditions.size() == 1);
    }
    SECTION("and nothing else") {
        for (const std::string text :
             {"x", "x == y", "x < 1 || y < 1", "!(x < 1)", "1 < 2", "x < 1 ? 1 : 0", "(x < 1) + 1", "x < 1/0"}) {
            CAPTURE(text);
            CHECK_THAT(error_of([&] { conditions_of(text); }), Contains("threshold: '" + text + "' is no comparison"));
        }
        CHECK_THAT(error_of([&] { conditions_of("x < "); }), Contains("x <"));
        CHECK_THAT(error_of([&] { conditions_of("nothing > 1"); }), Contains("nothing"));
    }
}

TEST_CASE("A threshold is for all that a scene shows, but for edges") {
    Stage stage;
    const std::string name = stage.volume.fields()[0].name;
    SECTION("by default what else is shown") {
        const FrameRequest request = stage.request(R"("threshold": "x < 0.25")");
        REQUIRE(request.surfaces.size() == 1);
        CHECK(request.surfaces[0].conditions.size() == 1);
    }
    SECTION("surfaces of the scene") {
        const FrameRequest request = stage.request(
            R"("threshold": "x < 0.25", "surfaces": [{"type": "plane", "plane": [0, 0, 1, 0]}, {"type": "wireframe"}])");
        CHECK(request.surfaces[0].conditions.size() == 1);
        CHECK(request.surfaces[1].conditions.empty());
    }
    SECTION("the density of the field that volume rendering shows") {
        const FrameRequest request = stage.request(R"("threshold": ")" + name + R"( > 0.25 && )" + name + R"( < 0.75",
            "volume_rendering": {"density": [[0, 1], [1, 3]]})");
        REQUIRE(request.volume);
        const TransferFunction& transfer = request.volume->transfer;
        CHECK(density_at(transfer, 0.24) == 0);
        CHECK(density_at(transfer, 0.26) == Approx(1.52));
        CHECK(density_at(transfer, 0.74) == Approx(2.48));
        CHECK(density_at(transfer, 0.76) == 0);
    }
    SECTION("not of another one") {
        CHECK_THAT(error_of([&] { stage.request(R"("threshold": "x < 0.25", "volume_rendering": {})"); }),
                   Contains("threshold: can cut volume rendering only by the field that it shows"));
    }
}
