// elvis-mpi as a user runs it, with one to four processes on this machine.

#include <tests/support/program_folder.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>

using namespace elvis::test;

namespace {

class MpiFolder : public ProgramFolder {
public:
    MpiFolder() {
        write("box.json", R"({"generator": 1, "mesh": "waves", "elements": [4, 3, 3], "order": 2, "field": "waves"})");
        REQUIRE(run("convert box.json -o box.h5").status == 0);
        // No more than it takes: each process makes its kernels.
        write("scene.json", R"({"version": 1, "volume": {"path": "box.h5"}, "image": {"size": [96, 72]},
            "surfaces": [{"type": "plane", "plane": [1, 0, 0, 0.1]}]})");
        write("volume.json",
              R"({"version": 1, "volume": {"path": "box.h5"}, "image": {"size": [64, 48]}, "volume_rendering": {},
            "surfaces": [{"type": "plane", "plane": [1, 0.2, 0, 0.1]}]})");
    }

    /** What a shell makes of these words for mpirun, where $E is elvis-mpi. */
    Outcome launch(const std::string& words) const {
        const std::string command =
            "cd '" + path().string() + "' && E='" ELVIS_MPI_PROGRAM "' && LP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 " +
            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 '" ELVIS_MPI_LAUNCHER "' --oversubscribe " + words + " >out.txt 2>err.txt";
        const int status = std::system(command.c_str());
        Outcome outcome;
        outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        outcome.out = read("out.txt");
        outcome.err = read("err.txt");
        return outcome;
    }
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::size_t count_of(const std::string& text, const std::string& word) {
    std::size_t n = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        ++n;
    }
    return n;
}

} // namespace

TEST_CASE("One to four processes draw the bytes that one program draws in the same parts") {
    const MpiFolder folder;
    REQUIRE(folder.run("render scene.json --parts 5 -o one.png --buffers one.h5").status == 0);
    const std::string picture = folder.read("one.png"), buffers = folder.read("one.h5");
    for (const std::string n : {"1", "2", "3", "4"}) {
        INFO(n << " processes");
        const Outcome outcome = folder.launch("-n " + n + " \"$E\" render scene.json --parts 5 -o many.png --buffers many.h5" +
                                              " --stats many.json");
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        CHECK(folder.read("many.png") == picture);
        CHECK(folder.read("many.h5") == buffers);
        const auto ranks = nlohmann::json::parse(folder.read("many.json"))["parts"]["ranks"];
        REQUIRE(ranks.size() == static_cast<std::size_t>(std::stoi(n)));
        std::uint64_t n_own = 0;
        for (const auto& rank : ranks) {
            n_own += rank["own_elements"].get<std::uint64_t>();
            CHECK(rank["peak_memory_bytes"].get<std::uint64_t>() > 0);
        }
        CHECK(n_own == 36);
    }
}

TEST_CASE("Light, wide lines, streaks and layers are the same by any number of processes, which share what is put together") {
    const MpiFolder folder;
    folder.write("lines.json", R"~({"version": 1, "volume": {"path": "box.h5"}, "image": {"size": [96, 72], "samples": 2},
        "surfaces": [{"type": "plane", "plane": [1, 0.2, 0, 0.1]}], "contours": {"count": 5, "width": 3}, "mesh_lines": {},
        "lic": {"length": 6, "field": "y*grad(x) - x*grad(y)"}, "lighting": "default"})~");
    folder.write("layers.json", R"~({"version": 1, "volume": {"path": "box.h5"}, "image": {"size": [96, 72]},
        "surfaces": [{"type": "plane", "plane": [1, 0.2, 0, 0.1]}, {"type": "isosurface", "values": [0.2, 0.5], "opacity": 0.4},
                     {"type": "boundary", "opacity": 0.3}], "volume_rendering": {}})~");
    for (const auto& [scene, counts] :
         {std::pair<std::string, std::vector<std::string>>{"volume", {"2", "4"}}, {"layers", {"2"}}, {"lines", {"3"}}}) {
        REQUIRE(folder.run("render " + scene + ".json --parts 3 -o one.png --buffers one.h5").status == 0);
        for (const std::string& n : counts) {
            INFO(scene << " by " << n << " processes");
            const Outcome outcome = folder.launch("-n " + n + " \"$E\" render " + scene +
                                                  ".json --parts 3 -o many.png --buffers many.h5 --stats many.json");
            INFO(outcome.err);
            REQUIRE(outcome.status == 0);
            CHECK(folder.read("many.png") == folder.read("one.png"));
            CHECK(folder.read("many.h5") == folder.read("one.h5"));
            for (const auto& rank : nlohmann::json::parse(folder.read("many.json"))["parts"]["ranks"]) {
                CHECK(rank["received_bytes"].get<std::uint64_t>() > 0);
            }
        }
    }
    // Without buffers less is sent; the picture is the same.
    REQUIRE(folder.launch("-n 3 \"$E\" render lines.json --parts 3 -o fewer.png").status == 0);
    CHECK(folder.read("fewer.png") == folder.read("one.png"));
}

TEST_CASE("More processes than parts: some have nothing to draw") {
    const MpiFolder folder;
    REQUIRE(folder.run("render scene.json --parts 2 -o one.png").status == 0);
    const Outcome outcome = folder.launch("-n 3 \"$E\" render scene.json --parts 2 -o many.png");
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(folder.read("many.png") == folder.read("one.png"));
}

TEST_CASE("A process that fails ends all, with one message that names it, and no file") {
    const MpiFolder folder;
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome = folder.launch("-n 1 \"$E\" render scene.json --parts 4 -o many.png : "
                                          "-n 1 \"$E\" render missing.json --parts 4 -o many.png : "
                                          "-n 1 \"$E\" render scene.json --parts 4 -o many.png");
    INFO(outcome.err);
    CHECK(seconds_since(start) < 10);
    CHECK(outcome.status != 0);
    CHECK(count_of(outcome.err, "elvis-mpi: rank") == 1);
    CHECK(outcome.err.find("elvis-mpi: rank 1: ") != std::string::npos);
    for (const std::string& name : names_in(folder)) {
        CHECK(name.find("many") == std::string::npos);
    }
}

TEST_CASE("A file that no process can read is told once") {
    const MpiFolder folder;
    const Outcome outcome = folder.launch("-n 3 \"$E\" render missing.h5 --parts 3 -o many.png");
    INFO(outcome.err);
    CHECK(outcome.status == 1);
    CHECK(count_of(outcome.err, "elvis-mpi: rank") == 1);
    CHECK(outcome.err.find("elvis-mpi: rank 0: missing.h5") != std::string::npos);
}

TEST_CASE("A process that is killed ends all") {
    const MpiFolder folder;
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome =
        folder.launch("-n 1 \"$E\" render scene.json --parts 4 -o many.png : "
                      "-n 1 sh -c '\"$0\" render scene.json --parts 4 -o many.png & sleep 0.3; kill -9 $!; wait $!' \"$E\"");
    INFO(outcome.err);
    CHECK(seconds_since(start) < 10);
    CHECK(outcome.status != 0);
    for (const std::string& name : names_in(folder)) {
        CHECK(name.find("many") == std::string::npos);
    }
}

TEST_CASE("Films: groups of processes draw pictures of their own, with the bytes of one process") {
    const MpiFolder folder;
    folder.write("film.json", R"({"version": 1, "volume": {"path": "box.h5"}, "image": {"size": [48, 36]},
        "surfaces": [{"type": "plane", "plane": [1, 0, 0, 0.1]}], "animation": {"turntable": {"frames": 5}}})");
    REQUIRE(folder.run("render film.json --parts 2 -o one").status == 0);
    for (const std::string n : {"3", "4"}) {
        INFO(n << " processes");
        std::filesystem::remove_all(folder.path("many"));
        const Outcome outcome = folder.launch("-n " + n + " \"$E\" render film.json --parts 2 -o many");
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        CHECK(outcome.err.find(n == "4" ? "by 2 groups" : "by 1 group") != std::string::npos);
        CHECK(outcome.err.find("rank 2 draws with ") != std::string::npos);
        for (const std::string picture : {"0", "1", "2", "3", "4"}) {
            CHECK(folder.read("many/frame_000" + picture + ".png") == folder.read("one/frame_000" + picture + ".png"));
        }
    }
    CHECK(folder.read("one/frame_0000.png") != folder.read("one/frame_0001.png"));
    // What is there stays.
    folder.write("many/frame_0001.png", "kept");
    std::filesystem::remove(folder.path("many/frame_0003.png"));
    REQUIRE(folder.launch("-n 4 \"$E\" render film.json --parts 2 -o many --resume").status == 0);
    CHECK(folder.read("many/frame_0001.png") == "kept");
    CHECK(folder.read("many/frame_0003.png") == folder.read("one/frame_0003.png"));
}

TEST_CASE("What sways is drawn in parts as in one piece, with its edges where they were") {
    const MpiFolder folder;
    folder.write("sway.json",
                 R"({"generator": 1, "mesh": "box", "elements": [4, 3, 3], "fields": ["sphere", "taylor-green"], "order": 2})");
    REQUIRE(folder.run("convert sway.json -o sway.h5").status == 0);
    folder.write("film.json", R"({"version": 1, "volume": {"path": "sway.h5"}, "image": {"size": [80, 60]},
        "warp": {"field": "velocity", "factor": 0.3}, "animation": {"phases": 3}, "surfaces": [{"type": "boundary"},
            {"type": "wireframe", "undeformed": true, "color": [0.9, 0.1, 0.1]}]})");
    REQUIRE(folder.run("render film.json -o whole").status == 0);
    REQUIRE(folder.run("render film.json --parts 2 -o one").status == 0);
    const Outcome outcome = folder.launch("-n 4 \"$E\" render film.json --parts 2 -o many");
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    for (const std::string picture : {"0", "1", "2"}) {
        INFO("picture " << picture);
        const std::string whole = folder.read("whole/frame_000" + picture + ".png");
        CHECK(folder.read("one/frame_000" + picture + ".png") == whole);
        CHECK(folder.read("many/frame_000" + picture + ".png") == whole);
    }
    CHECK(folder.read("one/frame_0000.png") != folder.read("one/frame_0001.png"));
}

TEST_CASE("Parts of a file are drawn by processes, too") {
    const MpiFolder folder;
    std::string parts;
    for (int element = 0; element < 36; ++element) {
        parts += std::to_string(element % 3) + "\n";
    }
    folder.write("parts.txt", parts);
    REQUIRE(folder.run("render scene.json --parts parts.txt -o one.png --buffers one.h5").status == 0);
    const Outcome outcome = folder.launch("-n 2 \"$E\" render scene.json --parts parts.txt -o many.png --buffers many.h5");
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(folder.read("many.png") == folder.read("one.png"));
    CHECK(folder.read("many.h5") == folder.read("one.h5"));
    CHECK(folder.run("render scene.json --parts 0 -o no.png").status == 2);
    CHECK(folder.run("render scene.json --parts missing.txt -o no.png").err.find("missing.txt: there is no such file") !=
          std::string::npos);
}

TEST_CASE("Conversion by processes gives the file of one process") {
    const MpiFolder folder;
    folder.write("mixed.json", R"({"generator": 1, "mesh": "waves", "shape": "mixed", "elements": [8, 6, 5], "order": 3,
        "time_steps": 2, "fields": ["waves", "element"]})");
    REQUIRE(folder.run("convert mixed.json -o one.h5 --report one.json", "SOURCE_DATE_EPOCH=1000000000").status == 0);
    for (const std::string n : {"1", "2", "3", "4"}) {
        INFO(n << " processes");
        const Outcome outcome = folder.launch(
            "-n " + n + " -x SOURCE_DATE_EPOCH=1000000000 \"$E\" convert mixed.json -o many.h5 --report many.json");
        INFO(outcome.err);
        REQUIRE(outcome.status == 0);
        if (std::system("command -v h5diff >/dev/null") == 0) {
            const std::string diff = "cd '" + folder.path("") + "' && h5diff one.h5 many.h5";
            CHECK(std::system(diff.c_str()) == 0);
        }
        CHECK(folder.read("many.h5").size() == folder.read("one.h5").size());
        auto one = nlohmann::json::parse(folder.read("one.json")), many = nlohmann::json::parse(folder.read("many.json"));
        one.erase("seconds");
        many.erase("seconds");
        CHECK(one == many);
    }
}

TEST_CASE("A conversion of which a process fails or is killed ends, and leaves no file") {
    const MpiFolder folder;
    // Long enough to be killed in the middle.
    folder.write("large.json", R"({"generator": 1, "mesh": "waves", "elements": [40, 40, 40], "order": 6, "time_steps": 4,
        "fields": ["waves", "sphere"]})");
    const std::string convert = " \"$E\" convert large.json -o many.h5";
    const std::string killed =
        " sh -c '\"$0\" convert large.json -o many.h5 & until ls many.h5.part* >/dev/null 2>&1; do sleep 0.05; "
        "done; sleep 0.3; touch killed; kill -9 $!; wait $!' \"$E\"";
    for (const std::string& words : {"-n 1" + convert + " : -n 1" + killed, "-n 1" + killed + " : -n 1" + convert}) {
        std::filesystem::remove(folder.path("killed"));
        const Outcome outcome = folder.launch(words);
        const auto end = std::filesystem::file_time_type::clock::now();
        INFO(words << "\n" << outcome.err);
        REQUIRE(std::filesystem::exists(folder.path("killed")));
        // A busy machine takes longer than the ten seconds that are promised.
        CHECK(end - std::filesystem::last_write_time(folder.path("killed")) < std::chrono::seconds(60));
        CHECK(outcome.status != 0);
        for (const std::string& name : names_in(folder)) {
            CHECK(name.find("many") == std::string::npos);
        }
    }
    const Outcome failed = folder.launch("-n 1" + convert + " : -n 1 \"$E\" convert missing.json -o many.h5");
    CHECK(failed.status != 0);
    CHECK(count_of(failed.err, "elvis-mpi: rank") == 1);
    CHECK(failed.err.find("elvis-mpi: rank 1: missing.json") != std::string::npos);
    for (const std::string& name : names_in(folder)) {
        CHECK(name.find("many") == std::string::npos);
    }
}

TEST_CASE("Processes without parts are wrong usage") {
    const MpiFolder folder;
    const Outcome outcome = folder.launch("-n 2 \"$E\" render scene.json -o many.png");
    CHECK(outcome.status == 2);
    CHECK(outcome.err.find("needs --parts") != std::string::npos);
}
