// elvis convert --separate-process: a conversion plugin that misbehaves ends alone, and nothing half-written is left.

#include "workplace.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <thread>
#include <utility>
#include <vector>

using namespace elvis::test;

namespace {

using Clock = std::chrono::steady_clock;

const std::string plugins = "ELVIS_PLUGIN_PATH='" ELVIS_FIXTURES "'";
const std::string plugin = "org.elvis.test.troubled-source";

std::string arguments(const std::string& trouble) {
    return "--quiet convert bad.tetrahedron --plugin " + plugin + " --separate-process -o bad.h5 --options '{\"trouble\": \"" +
           trouble + "\"}'";
}

/** Quiet: the other fixtures are refused with warnings. One line that names file, plugin and cause, status 1, and no file that
 * was not there before. */
void check_refusal(const std::string& trouble, const std::string& word, const std::string& more = "") {
    const Workplace place;
    place.write("bad.tetrahedron", "");
    place.run("--version"); // Makes the files that take what is printed.
    const std::size_t before = names_in(place).size();
    const Outcome outcome = place.run(arguments(trouble) + more, plugins);
    INFO(outcome.err);
    CHECK(outcome.status == 1);
    for (const std::string& part : {std::string("bad.tetrahedron"), plugin, word}) {
        CHECK(outcome.err.find(part) != std::string::npos);
    }
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(names_in(place).size() == before);
}

pid_t start(const Workplace& place, const std::string& trouble) {
    const std::string folder = place.path().string();
    const std::string options = "{\"trouble\": \"" + trouble + "\"}";
    const pid_t child = ::fork();
    if (child == 0) {
        const int file = ::open((folder + "/err.txt").c_str(), O_WRONLY | O_TRUNC);
        ::dup2(file, STDERR_FILENO);
        ::setenv("ELVIS_PLUGIN_PATH", ELVIS_FIXTURES, 1);
        if (::chdir(folder.c_str()) == 0) {
            ::execl(ELVIS_PROGRAM, ELVIS_PROGRAM, "convert", "bad.tetrahedron", "--plugin", plugin.c_str(),
                    "--separate-process", "-o", "bad.h5", "--options", options.c_str(), static_cast<char*>(nullptr));
        }
        ::_exit(127);
    }
    return child;
}

/** Processes that convert for this one. */
std::vector<pid_t> children_of(pid_t process) {
    std::ifstream file("/proc/" + std::to_string(process) + "/task/" + std::to_string(process) + "/children");
    return {std::istream_iterator<pid_t>(file), {}};
}

/** Interrupts a conversion that never returns, so often; returns the status and the seconds until the end. */
std::pair<int, double> interrupt(const Workplace& place, int n_times) {
    const pid_t process = start(place, "hang");
    REQUIRE(process > 0);
    std::vector<pid_t> children;
    const auto begin = Clock::now();
    while (children.empty() && Clock::now() - begin < std::chrono::seconds(20)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        children = children_of(process);
    }
    REQUIRE(children.size() == 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(500)); // Until it hangs.
    const auto sent = Clock::now();
    for (int i = 0; i < n_times; ++i) {
        ::kill(process, SIGTERM);
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    int status = 0;
    REQUIRE(::waitpid(process, &status, 0) == process);
    const double seconds = std::chrono::duration<double>(Clock::now() - sent).count();
    CHECK(::kill(children.front(), 0) != 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, seconds};
}

} // namespace

TEST_CASE("A volume converted in a separate process is the same") {
    const Workplace place;
    const Outcome outcome = place.run("convert ball.json --separate-process -o apart.h5 --json --fields sphere,velocity");
    INFO(outcome.err);
    REQUIRE(outcome.status == 0);
    CHECK(outcome.err.empty());
    auto apart = nlohmann::json::parse(outcome.out);
    auto here = nlohmann::json::parse(place.run("convert ball.json -o here.h5 --json --fields sphere,velocity").out);
    apart.erase("seconds");
    here.erase("seconds");
    CHECK(apart == here);
    const std::string points = " --point 0.1,0.2,-0.3 --point -0.4,0,0.1 --json";
    CHECK(place.run("probe apart.h5" + points).out == place.run("probe here.h5" + points).out);
}

TEST_CASE("What the separate process finds wrong is said as if there were none") {
    const Workplace place;
    place.write("bad.tetrahedron", "");
    const Outcome apart = place.run(arguments("geometry-order"), plugins);
    CHECK(apart.status == 1);
    const Outcome here = place.run("--quiet convert bad.tetrahedron --plugin " + plugin +
                                       " -o bad.h5 --options '{\"trouble\": \"geometry-order\"}'",
                                   plugins);
    CHECK(apart.err == here.err);
    CHECK(place.run("convert ball.json -o nowhere/ball.h5 --separate-process").status == 1);
    CHECK(place.run("convert ball.json -o ball2.h5 --memory-limit 100").status == 2);
}

TEST_CASE("A conversion plugin that crashes is named, with file, function and signal") {
    check_refusal("crash", "in its function sample");
    check_refusal("crash", "signal 11");
}

TEST_CASE("A conversion plugin that ends the process is named") { check_refusal("leave", "status 3"); }

TEST_CASE("A conversion plugin that takes too much memory is ended") {
    check_refusal("greed", "more than the 500 MiB", " --memory-limit 500");
}

TEST_CASE("A conversion plugin that never returns can be interrupted") {
    const Workplace place;
    place.write("bad.tetrahedron", "");
    place.run("--version");
    const std::size_t before = names_in(place).size();
    const auto [status, seconds] = interrupt(place, 1);
    CHECK(status == 1);
    CHECK(seconds > 2);  // It is given time to end by itself.
    CHECK(seconds < 60); // Some three; one that is not ended would go on for ever.
    CHECK(names_in(place).size() == before);
    CHECK(place.read("err.txt").find(plugin) != std::string::npos);
    const auto [at_once, shorter] = interrupt(place, 2);
    CHECK(at_once == 1);
    CHECK(shorter < 2);
    CHECK(names_in(place).size() == before);
}

TEST_CASE("A separate conversion ends with the program that started it") {
    const Workplace place;
    place.write("bad.tetrahedron", "");
    place.run("--version");
    const pid_t process = start(place, "hang");
    std::vector<pid_t> children;
    for (int i = 0; i < 2000 && children.empty(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        children = children_of(process);
    }
    REQUIRE(children.size() == 1);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
    const auto is_there = [&] {
        std::ifstream status("/proc/" + std::to_string(children.front()) + "/stat");
        std::string id, name, state;
        return status >> id >> name >> state && state != "Z";
    };
    for (int i = 0; i < 200 && is_there(); ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    CHECK_FALSE(is_there());
}
