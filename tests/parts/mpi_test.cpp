// elvis-mpi as a user runs it, with one to four processes on this machine.

#include <tests/support/program_folder.hpp>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <sys/wait.h>

#include <chrono>
#include <cstdlib>

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

TEST_CASE("The volume itself is the same by two processes") {
    const MpiFolder folder;
    REQUIRE(folder.run("render volume.json --parts 3 -o one.png --buffers one.h5").status == 0);
    const Outcome outcome = folder.launch("-n 2 \"$E\" render volume.json --parts 3 -o many.png --buffers many.h5");
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(folder.read("many.png") == folder.read("one.png"));
    CHECK(folder.read("many.h5") == folder.read("one.h5"));
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

TEST_CASE("Processes without parts are wrong usage") {
    const MpiFolder folder;
    const Outcome outcome = folder.launch("-n 2 \"$E\" render scene.json -o many.png");
    CHECK(outcome.status == 2);
    CHECK(outcome.err.find("needs --parts") != std::string::npos);
}
