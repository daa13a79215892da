// Surfaces that no pixel's ray meets are named, and no others.

#include "workplace.hpp"

using namespace elvis::test;

TEST_CASE("A surface that hits no pixel is named") {
    const Workplace place;
    const auto said = [&](const std::string& options) {
        const Outcome outcome = place.run("render ball.h5 --size 48x48 -o x.png " + options);
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        return outcome.err;
    };
    CHECK_THAT(said("--cut-plane 0,0,1,5 --cut-plane 0,0,1,0"),
               Catch::Contains("the cut plane 0,0,1,5 hits no pixel") && !Catch::Contains("0,0,1,0 hits"));
    CHECK_THAT(said("--field sphere --isosurface 7"),
               Catch::Contains("the isosurface at 7 of 'sphere' hits no pixel: the field's values lie"));
    // Of several values those that the field does not take; one that another encloses is there, and hidden.
    const std::string several = said("--field sphere --isosurface 7 --isosurface 0.3 --isosurface 8");
    CHECK_THAT(several, Catch::Contains("the isosurfaces at 7, 8 of 'sphere' hit no pixel"));
    CHECK_THAT(said("--field sphere --isosurface 0.3 --isosurface 0.6 --eye 0,0,4"), !Catch::Contains("no pixel"));
    // From a point within, the whole boundary of the ball is behind the eye.
    CHECK_THAT(said("--boundary --eye 0,0,4 --look-at 0,0,9"), Catch::Contains("the boundary hits no pixel"));
}

TEST_CASE("A surface that others hide hits pixels, and one that is clipped or not in the picture does not") {
    const Workplace place;
    const auto said = [&](const std::string& surfaces, const std::string& more = "") {
        place.write("scene.json",
                    R"({"version": 1, "volume": {"path": "ball.h5"}, "image": {"size": [48, 48]}, "surfaces": [)" + surfaces +
                        "]" + more + "}");
        std::string all;
        for (const char* share : {"none", "all"}) {
            const Outcome outcome = place.run("render scene.json -o x.png --share " + std::string(share));
            INFO(outcome.err);
            REQUIRE(outcome.status == 0);
            all += outcome.err;
        }
        return all;
    };
    const std::string ball = R"({"type": "boundary"})";
    const std::string inner = R"({"type": "sphere", "center": [0, 0, 0], "radius": 0.2})";
    const std::string outer = R"({"type": "sphere", "name": "far", "center": [9, 0, 0], "radius": 0.2})";
    CHECK_THAT(said(ball + "," + inner), !Catch::Contains("no pixel"));
    CHECK_THAT(said(inner + "," + ball), !Catch::Contains("no pixel"));
    CHECK_THAT(said(ball + "," + outer), Catch::Contains("the sphere 'far' hits no pixel"));
    const std::string unnamed = R"({"type": "sphere", "center": [9, 0, 0], "radius": 0.2})";
    CHECK_THAT(said(inner + "," + unnamed), Catch::Contains("the sphere (surfaces[1]) hits no pixel"));
    const std::string clipped = R"({"type": "plane", "plane": [0, 0, 1, 0], "clip": [[0, 0, 1, -0.5]]})";
    CHECK_THAT(said(clipped), Catch::Contains("hits no pixel, or all that does is clipped"));
    // A transparent surface within an opaque one is hidden, and there.
    CHECK_THAT(said(ball + R"(,{"type": "isosurface", "field": "sphere", "values": [0.1, 0.2], "opacity": 0.5})"),
               !Catch::Contains("no pixel"));
}

TEST_CASE("A volume without density is named, and what an animation never meets is named once") {
    const Workplace place;
    place.write("empty.json", R"({"color": [[0, 1, 0, 0]], "density": [[0, 0], [1, 0]]})");
    const Outcome empty = place.run("render ball.h5 --volume empty.json --size 32x32 -o x.png");
    CHECK(empty.status == 0);
    CHECK_THAT(empty.err, Catch::Contains("volume rendering colours no pixel"));
    CHECK_THAT(place.run("render ball.h5 --volume default --size 32x32 -o x.png").err, !Catch::Contains("colours no pixel"));
    const Outcome turned =
        place.run("render ball.h5 --cut-plane 0,0,1,5 --cut-plane 0,0,1,0 --turntable 3 --size 32x32 -o turn");
    INFO(turned.err);
    CHECK(turned.status == 0);
    const std::size_t first = turned.err.find("the cut plane 0,0,1,5 hits no pixel");
    REQUIRE(first != std::string::npos);
    CHECK(turned.err.find("0,0,1,5 hits", first + 20) == std::string::npos);
}
