// Files that people have are drawn as they are.

#include "workplace.hpp"

#include <algorithm>
#include <iterator>

using namespace elvis::test;
using Catch::Contains;

namespace {

const std::string star = ELVIS_SOURCES "/tests/data/mfem-more/star-h1-p3/";

std::size_t n_kept(const ProgramFolder& place) {
    std::error_code ignored;
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(place.path("cache/volumes"), ignored), fs::directory_iterator()));
}

/** With a cache of its own. */
Outcome run_with_cache(const ProgramFolder& place, const std::string& command, const std::string& limit = "") {
    fs::create_directories(place.path("temporary"));
    return place.run(command, "TMPDIR=" + place.path("temporary") + " ELVIS_CACHE_PATH=" + place.path("cache") +
                                  " ELVIS_VOLUME_CACHE_MIB=" + limit);
}

} // namespace

TEST_CASE("A foreign file is converted once, which is said once, and again when it has changed") {
    const ProgramFolder place;
    const std::string box = R"({"generator": 1, "mesh": "box", "elements": [2, 1, 1], "field": "sphere"})";
    place.write("box.json", box);
    const Outcome first = run_with_cache(place, "info box.json");
    INFO(first.err);
    CHECK(first.status == 0);
    CHECK_THAT(first.err, Contains("info: box.json: converted by org.elvis.generator, exact; kept in the cache ("));
    CHECK_THAT(first.out, Contains("2 elements"));
    const Outcome second = run_with_cache(place, "info box.json");
    CHECK(second.err.empty());
    CHECK(second.out == first.out);
    CHECK(n_kept(place) == 1);

    place.write("box.json", R"({"generator": 1, "mesh": "box", "elements": [3, 1, 1], "field": "sphere"})");
    const Outcome third = run_with_cache(place, "info box.json");
    CHECK_THAT(third.err, Contains("kept in the cache"));
    CHECK_THAT(third.out, Contains("3 elements"));
    CHECK(n_kept(place) == 2);
}

TEST_CASE("What a conversion loses is said each time") {
    const ProgramFolder place;
    place.write("sinc.json", R"({"generator": 1, "mesh": "box", "elements": [1, 1, 1], "field": "sinc", "order": 2})");
    for (int time = 0; time < 2; ++time) {
        CHECK_THAT(run_with_cache(place, "info sinc.json").err,
                   Contains("warning: sinc.json: converted by org.elvis.generator, NOT exact: the largest residual is "));
    }
}

TEST_CASE("Where a field is not a number is told, and is no residual") {
    const ProgramFolder place;
    const std::string solid = ELVIS_SOURCES "/tests/data/exodus/solid.e";
    const std::string gaps = "field material is not a number in 3 elements";
    CHECK_THAT(run_with_cache(place, "info " + solid).err, Contains("NOT exact: " + gaps) && !Contains("residual"));
    const Outcome converted = run_with_cache(place, "convert " + solid + " -o solid.h5");
    CHECK_THAT(converted.out, Contains("field material: NOT exact") && Contains(", not a number in 3 elements\n"));
    CHECK_THAT(converted.out, Contains("field u: exact but for round-off"));
}

TEST_CASE("Without a cache the volume is gone at the end") {
    const ProgramFolder place;
    place.write("box.json", R"({"generator": 1, "mesh": "box", "elements": [2, 1, 1], "field": "sphere"})");
    const Outcome outcome = run_with_cache(place, "info box.json", "0");
    CHECK(outcome.status == 0);
    CHECK_THAT(outcome.err, Contains("kept until the end"));
    CHECK(fs::is_empty(place.path("temporary")));
    CHECK(n_kept(place) == 0);
}

TEST_CASE("The cache of volumes forgets what was not used for the longest time") {
    const ProgramFolder place;
    for (const char* name : {"a", "b", "c"}) {
        place.write(std::string(name) + ".json",
                    R"({"generator": 1, "mesh": "box", "elements": [8, 8, 8], "order": 6, "field": "sinc"})");
        CHECK(run_with_cache(place, "info " + std::string(name) + ".json", "1").status == 0);
    }
    CHECK(n_kept(place) == 1);
    CHECK_THAT(run_with_cache(place, "info c.json", "1").err, !Contains("kept in the cache"));
}

TEST_CASE("A mesh and its field are one volume, for commands and in scenes") {
    const ProgramFolder place;
    const Outcome info = run_with_cache(place, "info " + star + "mesh.mesh " + star + "sol.gf");
    INFO(info.err);
    CHECK(info.status == 0);
    CHECK_THAT(info.err, Contains("mesh.mesh sol.gf: converted by org.elvis.mfem, exact"));
    CHECK_THAT(info.out, Contains("field sol"));
    place.write("scene.json", R"({"version": 1, "volume": {"path": ")" + star + R"(mesh.mesh", "more_paths": [")" + star +
                                  R"(sol.gf"]}, "image": {"size": [16, 16]}})");
    const Outcome drawn = run_with_cache(place, "render scene.json -o scene.png");
    INFO(drawn.err);
    CHECK(drawn.status == 0);
    CHECK(run_with_cache(place, "render " + star + "mesh.mesh " + star + "sol.gf --size 16x16 -o files.png").status == 0);
    CHECK(n_kept(place) == 1);
    CHECK_THAT(run_with_cache(place, "render " + star + "mesh.mesh scene.json -o x.png").err, Contains("is a scene"));
}

TEST_CASE("A file that nobody reads gets a message that says what it seems to be") {
    const ProgramFolder place;
    place.write("a.plt", "#!TDV112");
    place.write("b.cas", "nothing that anyone knows\n");
    place.write("c.mesh", "no mesh of MFEM\n");
    CHECK_THAT(place.run("info a.plt").err, Contains("it seems to be Tecplot (binary); ParaView"));
    CHECK_THAT(place.run("convert a.plt -o a.h5").err, Contains("it seems to be Tecplot"));
    CHECK_THAT(place.run("info b.cas").err, Contains("elvis plugins lists the formats"));
    CHECK_THAT(place.run("info c.mesh").err, Contains("its name is that of MFEM mesh (org.elvis.mfem)"));
    CHECK_THAT(place.run("render " ELVIS_SOURCES "/tests/data/window.png -o x.png").err, Contains("a PNG picture"));
}

TEST_CASE("The list of plugins has names and endings of the formats") {
    const ProgramFolder place;
    CHECK_THAT(place.run("plugins").out, Contains("reads MFEM mesh: *.mesh"));
    const auto list = nlohmann::json::parse(place.run("plugins --json").out)["plugins"];
    const auto mfem =
        std::find_if(list.begin(), list.end(), [](const auto& plugin) { return plugin["id"] == "org.elvis.mfem"; });
    REQUIRE(mfem != list.end());
    const auto& formats = (*mfem)["formats"];
    CHECK(std::any_of(formats.begin(), formats.end(),
                      [](const auto& format) { return format["endings"] == nlohmann::json{".gf"}; }));
}
