// Pictures by several devices, as a user asks for them: the first device, opened twice, stands in for two.

#include "workplace.hpp"

using namespace elvis::test;

namespace {

const std::string view = "--cut-plane 0,0,1,0.1 --contours 0.2,0.5 --boundary --annotation default --size 90x75 ";

} // namespace

TEST_CASE("Several devices draw a still picture to the bytes of one") {
    const Workplace place;
    REQUIRE(place.run("render ball.h5 -o one.png --buffers one.h5 --bits 16 " + view).status == 0);
    const Outcome two =
        place.run("render ball.h5 -o two.png --buffers two.h5 --bits 16 --devices 0,0 --stats stats.json " + view);
    INFO(two.err);
    REQUIRE(two.status == 0);
    CHECK(place.read("one.png") == place.read("two.png"));
    CHECK(place.read("one.h5") == place.read("two.h5"));
    CHECK(nlohmann::json::parse(place.read("stats.json"))["counts"]["pixels"] == 90 * 75);
    REQUIRE(place.run("render ball.h5 -o all.png --bits 16 --devices all --validation " + view).status == 0);
    CHECK(place.read("one.png") == place.read("all.png"));
}

TEST_CASE("Several devices draw the pictures of a film to the bytes of one") {
    const Workplace place;
    REQUIRE(place.run("render ball.h5 -o one --turntable 3 " + view).status == 0);
    REQUIRE(place.run("render ball.h5 -o three --turntable 3 --devices 0,0,0 " + view).status == 0);
    for (const char* frame : {"frame_0000.png", "frame_0001.png", "frame_0002.png"}) {
        CHECK(place.read(std::string("one/") + frame) == place.read(std::string("three/") + frame));
    }
    CHECK(place.read("one/frame_0000.png") != place.read("one/frame_0001.png"));
}

TEST_CASE("Devices that are not there, and lists that are none, are told") {
    const Workplace place;
    for (const char* list : {"0,nobody", "0,,0", "0,"}) {
        INFO(list);
        const Outcome refused = place.run("render ball.h5 -o x.png --devices " + std::string(list));
        CHECK(refused.status == 1);
        CHECK_FALSE(fs::exists(place.path("x.png")));
    }
    CHECK(place.run("render ball.h5 -o x.png --devices 0,nobody").err.find("'nobody'") != std::string::npos);
    CHECK(place.run("render ball.h5 -o x.png --devices all --device 0").status == 2);
}
