// A plugin that misbehaves does not take the program down without a word: every message names the plugin.

#include <catch2/catch.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Outcome {
    /** Exit status; of signals 128 and the number. */
    int status = -1;
    std::string err;
};

/** elvis render of the defective plugin's volume. */
Outcome render(const std::string& defect, const std::string& scale = "0.75") {
    const fs::path folder = fs::temp_directory_path() / ("elvis-safety-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    std::ofstream(folder / "volume.defective") << "defective 1\n" << scale << "\n";
    const std::string command = "cd '" + folder.string() + "' && ulimit -c 0 && ELVIS_DEFECT='" + defect +
                                "' ELVIS_PLUGIN_PATH='" + fs::path(DEFECTIVE_PLUGIN).parent_path().string() +
                                "' '" ELVIS_PROGRAM
                                "' render volume.defective --cut-plane 0,0,1,0 --size 32x32 -o out.png 2>err.txt; exit $?";
    const int status = std::system(("bash -c '" +
                                    [&] {
                                        std::string quoted;
                                        for (const char c : command) {
                                            quoted += c == '\'' ? "'\\''" : std::string(1, c);
                                        }
                                        return quoted;
                                    }() +
                                    "' 2>/dev/null")
                                       .c_str());
    std::stringstream text;
    text << std::ifstream(folder / "err.txt").rdbuf();
    fs::remove_all(folder);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text.str()};
}

void check_message(const Outcome& outcome, const std::string& word) {
    INFO(outcome.err);
    CHECK(outcome.status != 0);
    CHECK(outcome.err.find("org.elvis.test.defective") != std::string::npos);
    CHECK(outcome.err.find(word) != std::string::npos);
}

} // namespace

TEST_CASE("The plugin without a defect is drawn") { CHECK(render("").status == 0); }

TEST_CASE("A plugin that crashes is named, with the function") { check_message(render("crash"), "get_info"); }

TEST_CASE("A plugin that returns nonsense counts is named") { check_message(render("nonsense-count"), "get_info"); }

TEST_CASE("A plugin with bounds that are not finite is named") { check_message(render("damage-nonsense", "-1"), "get_bounds"); }

TEST_CASE("A snippet that does not compile is reported with its file and line") {
    const Outcome outcome = render("glsl-syntax");
    INFO(outcome.err);
    CHECK(outcome.status == 1);
    CHECK(outcome.err.find("defective.glsl:7") != std::string::npos);
}
