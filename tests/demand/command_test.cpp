// Budgets as people give them: pictures, statistics and errors of the program.

#include <tests/support/program_folder.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <string>

using namespace elvis::test;

namespace {

const std::string plane = " --cut-plane 0.2,0.1,1,0.05 --mesh-lines --size 160x120 --range -1.5,1.5 --field pressure ";

void write_lattice(const ProgramFolder& place, const std::string& elements) {
    place.write("lattice.txt", "elvis-lattice 1\nelements " + elements + "\nmoved 0.2\nfield pressure 2 3 1.5 1 Pa\n");
}

} // namespace

TEST_CASE("A plane through a million elements takes a small part of the memory, and is the same picture") {
    const ProgramFolder place;
    write_lattice(place, "60 50 40");
    REQUIRE(place.run("render lattice.txt" + plane + "-o whole.png --buffers whole.h5").status == 0);
    const Outcome drawn =
        place.run("render lattice.txt" + plane +
                  "--device-memory 72M --host-memory 1G -o chosen.png --buffers chosen.h5 --stats stats.json");
    INFO(drawn.err);
    REQUIRE(drawn.status == 0);
    CHECK(place.read("whole.png") == place.read("chosen.png"));
    CHECK(place.read("whole.h5") == place.read("chosen.h5"));
    const auto took = nlohmann::json::parse(place.read("stats.json"))["demand"];
    std::printf("120000 elements: %s\n", took.dump().c_str());
    CHECK(took["elements"] == 120000);
    CHECK(took["elements_on_device"] < 6000);
    CHECK(took["device_bytes"] < (72 << 20));

    write_lattice(place, "100 100 100");
    const Outcome large =
        place.run("render lattice.txt" + plane + "--device-memory 72M --host-memory 1G -o large.png --stats stats.json");
    INFO(large.err);
    REQUIRE(large.status == 0);
    const auto of_large = nlohmann::json::parse(place.read("stats.json"))["demand"];
    std::printf("1000000 elements: %s\n", of_large.dump().c_str());
    CHECK(of_large["elements"] == 1000000);
    CHECK(of_large["device_bytes"] < (72 << 20));
    CHECK(of_large["peak_memory_bytes"] < (std::uint64_t{512} << 20));
}

TEST_CASE("An isosurface near an extremum takes a small part of the memory, and is the same picture") {
    const ProgramFolder place;
    write_lattice(place, "40 40 30");
    const std::string isosurface = " --isosurface 1.4 --size 160x120 --range -1.5,1.5 ";
    REQUIRE(place.run("render lattice.txt" + isosurface + "-o whole.png --buffers whole.h5").status == 0);
    const std::string budget = "--device-memory 256M --host-memory 1G ";
    const Outcome drawn =
        place.run("render lattice.txt" + isosurface + budget + "-o chosen.png --buffers chosen.h5 --stats stats.json");
    INFO(drawn.err);
    REQUIRE(drawn.status == 0);
    CHECK(place.read("whole.png") == place.read("chosen.png"));
    CHECK(place.read("whole.h5") == place.read("chosen.h5"));
    const auto took = nlohmann::json::parse(place.read("stats.json"))["demand"];
    std::printf("48000 elements: %s\n", took.dump().c_str());
    CHECK(took["elements_on_device"] < 12000);
    CHECK(took["device_bytes"] < (256 << 20));

    // To search for extrema would take more than the budget: what encloses them is told.
    write_lattice(place, "150 150 150");
    const Outcome missed =
        place.run("render lattice.txt --isosurface 9 --range -1,1 --size 16x12 --host-memory 400M -o missed.png");
    INFO(missed.err);
    CHECK(missed.status == 0);
    CHECK(missed.err.find("hits no pixel: the field's values lie") != std::string::npos);
}

TEST_CASE("What does not fit a budget is told, with figures, and nothing is written") {
    const ProgramFolder place;
    write_lattice(place, "100 100 100");
    const auto refused = [&](const std::string& options, int status, const std::string& words) {
        const Outcome outcome = place.run("render lattice.txt --size 160x120 --range -1,1 " + options + " -o picture.png");
        INFO(options << ": " << outcome.err);
        CHECK(outcome.status == status);
        CHECK(outcome.err.find(words) != std::string::npos);
        CHECK(names_in(place) == std::vector<std::string>{"err.txt", "lattice.txt", "out.txt"});
    };
    refused("--cut-plane 0,0,1,0.1 --device-memory 20M", 1, "the picture takes, whatever it shows,");
    refused("--cut-plane 0,0,1,0.1 --cut-plane 0,1,1,0.1 --device-memory 42M", 1, "the cut plane (surface 1) needs more than");
    refused("--boundary --device-memory 20M", 1, "the boundary (surface 0) needs");
    refused("--isosurface 0.2 --device-memory 100M", 1, "the isosurface (surface 0) needs");
    refused("--isosurface 0.2 --mesh-lines --device-memory 100M", 1,
            "an isosurface with lines on it needs all 1000000 elements, at least");
    refused("--cut-plane 0,0,1,0.1 --host-memory 100M", 1, "on the host, and the budget is 100 MiB");
    refused("--cut-plane 0,0,1,0.1 --device-memory 2Q", 2, "'2Q' is no size");
    refused("--cut-plane 0,0,1,0.1 --host-memory -1", 2, "'-1' is no size");
    refused("--cut-plane 0,0,1,0.1 --device-memory 2G --parts 2", 2, "does not go with --parts");
    refused("--isosurface 0.2 --mesh-lines --device-memory 2G --samples 2", 1,
            "needs all elements: within a budget of memory it has one sample a pixel");
}

TEST_CASE("Displaced volumes, and fields joined to a volume, are drawn within a budget, too") {
    const ProgramFolder place;
    place.write("box.json",
                R"({"generator":1,"mesh":"box","elements":[5,5,5],"order":2,"fields":["taylor-green"],"time_steps":2})");
    REQUIRE(place.run("convert box.json -o box.h5").status == 0);
    const std::string picture = "render box.h5 --cut-plane 0.2,0.1,1,0.05 --size 160x120 --warp velocity --join later=@1 "
                                "--field \"pressure - later.pressure\" --range -1,1 ";
    const Outcome whole = place.run(picture + "-o whole.png");
    INFO(whole.err);
    REQUIRE(whole.status == 0);
    const Outcome chosen = place.run(picture + "--device-memory 1G -o chosen.png");
    INFO(chosen.err);
    REQUIRE(chosen.status == 0);
    CHECK(place.read("whole.png") == place.read("chosen.png"));
}

TEST_CASE("A plugin whose records belong to no elements is refused within a budget") {
    const ProgramFolder place;
    const Outcome outcome = place.run("render '" ELVIS_SOURCES "/plugins/analytic/samples/twisted_box.txt' --cut-plane 0,0,1,0 "
                                      "--device-memory 1G -o picture.png");
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("does not say that records belong to elements") != std::string::npos);
}
