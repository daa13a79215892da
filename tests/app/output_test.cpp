// Files are written in the format that their names promise, or not at all; and ranges by percentiles.

#include "workplace.hpp"

using namespace elvis::test;

TEST_CASE("A name that promises another format is refused before any work, with what is supported") {
    const Workplace place;
    const struct {
        const char* arguments;
        const char* file;
        const char* says;
    } cases[] = {
        {"render missing.h5 -o x.jpg", "x.jpg", "--output: 'x.jpg' does not end in .png"},
        {"render ball.h5 -o x.bmp", "x.bmp", ".png"},
        {"render ball.h5 -o x", "x", ".png"},
        {"render ball.h5 -o x.png --buffers x.npz", "x.npz", "--buffers: 'x.npz' does not end in .h5 or .hdf5"},
        {"render ball.h5 -o x.png --stats x.yaml", "x.yaml", ".json"},
        {"render ball.h5 -o turn --turntable 2 --film x.txt", "x.txt", ".mp4"},
        {"export ball.h5 -o x.obj", "x.obj", ".vtu"},
        {"convert ball.json -o x.vtu", "x.vtu", ".h5"},
        {"convert ball.json -o y.h5 --report x.txt", "x.txt", ".json"},
    };
    for (const auto& bad : cases) {
        INFO(bad.arguments);
        const Outcome outcome = place.run(bad.arguments);
        INFO(outcome.err);
        CHECK(outcome.status == 2);
        CHECK_THAT(outcome.err, Catch::Contains(bad.says));
        CHECK_FALSE(fs::exists(place.path(bad.file)));
    }
    CHECK(place.run("render ball.h5 --size 8x8 -o X.PNG").status == 0);
}

TEST_CASE("Percentiles are of the volume, not of elements or pixels") {
    const Workplace place;
    // x over a box from -1 to 1 takes each value equally often.
    place.write("box.json", R"({"generator": 1, "mesh": "box", "box": [[-1, -1, -1], [1, 1, 1]], "elements": [3, 2, 2],
        "order": 2, "field": "taylor-green", "time_steps": 3})");
    REQUIRE(place.run("convert box.json -o box.h5").status == 0);
    const std::string rest = " --field x --cut-plane 0,0,1,0.1 --size 8x8 -o x.png";
    const Outcome drawn = place.run("--verbose render box.h5 --range 10%,90%" + rest);
    INFO(drawn.err);
    REQUIRE(drawn.status == 0);
    const std::size_t at = drawn.err.find("range: ");
    REQUIRE(at != std::string::npos);
    double lower = 0, upper = 0;
    REQUIRE(std::sscanf(drawn.err.c_str() + at, "range: %lf to %lf", &lower, &upper) == 2);
    // 12000 points: a standard deviation of 0.0055 at these percentiles.
    CHECK(std::abs(lower + 0.8) < 0.03);
    CHECK(std::abs(upper - 0.8) < 0.03);
    REQUIRE(
        place.run("render box.h5 --range 10%,90% --parts 3 --field x --cut-plane 0,0,1,0.1 --size 8x8 -o parts.png").status ==
        0);
    CHECK(place.read("parts.png") == place.read("x.png"));
    CHECK(place.run("render box.h5 --range 2%,98 " + rest).status == 2);
    CHECK(place.run("render box.h5 --range 98%,2% " + rest).status == 2);
    CHECK(place.run("render box.h5 --range 2%,102% " + rest).status == 2);
    // Of all steps that are drawn: of one step the picture has other colours.
    const std::string view = " --field 'velocity[0]' --range 5%,95% --cut-plane 0,0,1,0.1 --eye 2,1,3 --size 24x24 -o ";
    REQUIRE(place.run("render box.h5 --time-steps 0:2:2" + view + "steps").status == 0);
    REQUIRE(place.run("render box.h5 --time-step 2" + view + "one.png").status == 0);
    CHECK(place.read("steps/frame_0001.png") != place.read("one.png"));
    REQUIRE(place.run("render box.h5 --parts 2 --time-steps 0:2:2" + view + "part_steps").status == 0);
    CHECK(place.read("part_steps/frame_0001.png") == place.read("steps/frame_0001.png"));
}

TEST_CASE("Several scenes are drawn by one process, each as if alone") {
    const Workplace place;
    const char* cut = R"({"version": 1, "volume": {"path": "ball.h5"}, "image": {"size": [24, 16]},
        "surfaces": [{"type": "plane", "plane": [0, 0, 1, 0.1]}]})";
    const char* boundary = R"({"version": 1, "volume": {"path": "ball.h5"}, "image": {"size": [16, 16]}, "precision": "float64",
        "surfaces": [{"type": "boundary"}]})";
    place.write("cut.json", cut);
    place.write("boundary.json", boundary);
    place.write("again.json", cut);
    const Outcome all = place.run(
        "render cut.json boundary.json again.json -o pictures --stats pictures --buffers buffers --color-map viridis");
    INFO(all.err);
    REQUIRE(all.status == 0);
    for (const std::string name : {"cut", "boundary", "again"}) {
        INFO(name);
        REQUIRE(place.run("render " + name + ".json -o alone.png --color-map viridis").status == 0);
        CHECK(place.read("pictures/" + name + ".png") == place.read("alone.png"));
        CHECK(fs::exists(place.path("buffers/" + name + ".h5")));
        const nlohmann::json stats = nlohmann::json::parse(place.read("pictures/" + name + ".json"));
        CHECK(stats["counts"]["pixels"] == (name == "boundary" ? 256 : 384));
        CHECK(stats["submissions"].get<int>() > 3);
        CHECK(stats["host_waits"] == stats["submissions"]); // Each is waited for, as yet.
        // Of all kernels that the process has made so far, the one that took longest first.
        REQUIRE_FALSE(stats["kernels"].empty());
        for (const nlohmann::json& kernel : stats["kernels"]) {
            CHECK_FALSE(kernel["kernel"].get<std::string>().empty());
            CHECK(kernel["driver"].get<double>() > 0);
            CHECK(kernel["bytes"].get<int>() > 0);
        }
    }
}

TEST_CASE("Several inputs that are not scenes of their own names are refused before any work") {
    const Workplace place;
    fs::create_directory(place.path("other"));
    for (const char* name : {"a.json", "b.json", "other/a.json"}) {
        place.write(name, R"({"version": 1, "volume": {"path": "ball.h5"}})");
    }
    const struct {
        const char* arguments;
        const char* says;
    } cases[] = {
        {"a.json ball.h5 -o new", "'ball.h5' is one of several inputs, and no scene file"},
        {"a.json other/a.json -o new", "'other/a.json' has the name of another scene"},
        {"a.json b.json -o ball.h5", "--output: 'ball.h5' is a file"},
        {"a.json b.json -o new --film x.mp4", "--film: is of one scene"},
    };
    for (const auto& bad : cases) {
        INFO(bad.arguments);
        const Outcome outcome = place.run("render " + std::string(bad.arguments));
        INFO(outcome.err);
        CHECK(outcome.status == 2);
        CHECK_THAT(outcome.err, Catch::Contains(bad.says));
        CHECK_FALSE(fs::exists(place.path("new")));
    }
}
