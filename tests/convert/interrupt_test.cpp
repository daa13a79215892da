// Ctrl-C during a conversion leaves nothing behind.
#include "fixture.hpp"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

namespace {

struct Outcome {
    int status = -1;
    double seconds = 0;
    bool was_writing = false;
};

// Starts the program, interrupts it as soon as its output folder holds a second file, and waits for its end.
Outcome interrupt(const TemporaryFolder& folder, int signal_number) {
    using clock = std::chrono::steady_clock;
    const std::string input = folder.path("big.json");
    const std::string output = folder.path("big.h5");
    const pid_t child = fork();
    if (child == 0) {
        const int null = open("/dev/null", O_WRONLY);
        dup2(null, STDERR_FILENO);
        execl(ELVIS_PROGRAM, ELVIS_PROGRAM, "convert", input.c_str(), "-o", output.c_str(), static_cast<char*>(nullptr));
        _exit(127);
    }
    REQUIRE(child > 0);
    Outcome outcome;
    const auto start = clock::now();
    while (!outcome.was_writing && clock::now() - start < std::chrono::seconds(60)) {
        outcome.was_writing = names_in(folder).size() > 1;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const auto sent = clock::now();
    kill(child, signal_number);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    outcome.seconds = std::chrono::duration<double>(clock::now() - sent).count();
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
}

} // namespace

TEST_CASE("an interrupted conversion leaves nothing behind", "[convert]") {
    const TemporaryFolder folder;
    // A minute of work.
    folder.write("big.json", R"({"generator":1,"mesh":"waves","elements":64,"geometry_order":2,"order":10,"field":"waves"})");
    for (int signal_number : {SIGINT, SIGTERM}) {
        const Outcome outcome = interrupt(folder, signal_number);
        CHECK(outcome.was_writing);
        CHECK(outcome.status == 1);
        CHECK(outcome.seconds < 30);
        CHECK(names_in(folder).size() == 1);
    }
}
