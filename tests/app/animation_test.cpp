// Pictures one after the other, as a user asks for them.

#include "workplace.hpp"

using namespace elvis::test;

namespace {

std::size_t n_pictures(const fs::path& folder) {
    std::size_t n = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
        n += entry.path().extension() == ".png" ? 1 : 0;
        // Nothing half made is left.
        CHECK(entry.path().filename().string().find("part") == std::string::npos);
    }
    return n;
}

} // namespace

TEST_CASE("A turntable and time steps become numbered pictures, the same as single ones") {
    const Workplace place;
    place.write("wave.json",
                R"({"generator": 1, "mesh": "box", "box": [[-1, -1, -1], [1, 1, 1]], "elements": [2, 2, 2], "order": 3,
        "field": "taylor-green", "time_steps": 3})");
    REQUIRE(place.run("convert wave.json -o wave.h5").status == 0);
    const std::string view = "--size 40x30 --cut-plane 0,0,1,0.1 --eye 2,1,3 ";
    const Outcome turned = place.run("render wave.h5 -o turn --time-steps all --turntable 6 --stats stats.json " + view);
    INFO(turned.err);
    REQUIRE(turned.status == 0);
    CHECK(n_pictures(place.path("turn")) == 6);
    const auto stats = nlohmann::json::parse(place.read("stats.json"));
    REQUIRE(stats["frames"].size() == 6);
    CHECK(stats["frames"][1]["time_step"] == 0);
    CHECK(stats["frames"][2]["time_step"] == 1);
    CHECK(stats["frames"][5]["file"] == "frame_0005.png");
    CHECK(stats["frames"][5]["counts"]["hit_pixels"].get<int>() > 50);

    // One step, seen from where the scene says: with the colours' range given, to the byte a picture of its own.
    REQUIRE(place.run("render wave.h5 -o steps --time-steps 2:0:2 --range -1,1 " + view).status == 0);
    CHECK(n_pictures(place.path("steps")) == 2);
    REQUIRE(place.run("render wave.h5 -o last.png --time-step 2 --range -1,1 " + view).status == 0);
    CHECK(place.read("steps/frame_0000.png") == place.read("last.png"));
    CHECK(place.read("steps/frame_0001.png") != place.read("last.png"));
    // Without one it is the range over all steps that are drawn.
    REQUIRE(place.run("render wave.h5 -o free --time-steps 2:0:2 " + view).status == 0);
    REQUIRE(place.run("render wave.h5 -o free.png --time-step 2 " + view).status == 0);
    CHECK(place.read("free/frame_0000.png") != place.read("free.png"));
}

TEST_CASE("An animation that was stopped goes on where it was") {
    const Workplace place;
    place.write("scene.json", R"({"version": 1, "volume": {"path": "ball.h5"}, "image": {"size": [32, 24]},
        "animation": {"key_frames": [{"frame": 0, "eye": [3, 0, 1]}, {"frame": 4, "eye": [0, 3, 1]}]}})");
    REQUIRE(place.run("render scene.json -o path").status == 0);
    CHECK(n_pictures(place.path("path")) == 5);
    const std::string third = place.read("path/frame_0002.png");
    fs::remove(place.path("path/frame_0002.png"));
    place.write("path/frame_0004.png", "kept");
    const Outcome resumed = place.run("render scene.json -o path --resume --stats stats.json");
    INFO(resumed.err);
    REQUIRE(resumed.status == 0);
    CHECK(place.read("path/frame_0002.png") == third);
    CHECK(place.read("path/frame_0004.png") == "kept");
    CHECK(nlohmann::json::parse(place.read("stats.json"))["frames"].size() == 1);
    REQUIRE(place.run("render scene.json -o path").status == 0);
    CHECK(place.read("path/frame_0004.png") != "kept");
}

TEST_CASE("A film is made where there is ffmpeg, and else it is said before anything is drawn") {
    const Workplace place;
    const std::string turn = "render ball.h5 -o turn --turntable 3 --size 33x25 --film film.mp4";
    if (std::system("command -v ffmpeg >/dev/null") == 0) {
        const Outcome made = place.run(turn + " --frames-a-second 12.5");
        INFO(made.err);
        CHECK(made.status == 0);
        CHECK(fs::file_size(place.path("film.mp4")) > 500);
        // A film that cannot be written.
        const Outcome nowhere = place.run("render ball.h5 -o turn --turntable 2 --size 8x8 --film no/folder/film.mp4");
        CHECK(nowhere.status == 1);
        CHECK(nowhere.err.find("film.mp4") != std::string::npos);
    }
    fs::remove_all(place.path("turn"));
    const std::string path = std::getenv("PATH");
    ::setenv("PATH", "/nonexistent", 1);
    const Outcome refused = place.run(turn);
    ::setenv("PATH", path.c_str(), 1);
    CHECK(refused.status == 1);
    CHECK(refused.err.find("ffmpeg") != std::string::npos);
    CHECK_FALSE(fs::exists(place.path("turn")));
}

TEST_CASE("What does not go with an animation is refused") {
    const Workplace place;
    for (const char* options :
         {"-o a.png --turntable 3", "-o a --turntable 3 --buffers b.h5", "-o a --turntable 0", "-o a --time-steps some",
          "-o a.png --film f.mp4", "-o a.png --resume", "-o ball.h5 --turntable 3", "-o a --turntable 3 --turntable-axis 0,0,0",
          "-o a --time-steps all --turntable-axis 0,0,1"}) {
        CAPTURE(options);
        CHECK(place.run(std::string("render ball.h5 ") + options).status == 2);
    }
    CHECK(place.run("render ball.h5 -o a --time-steps 0:1").status == 1);
}
