// The tutorial cannot rot: its commands are run in order on a new project, with the files of each step, and its listings are
// parts of those files.

#include <tests/support/files.hpp>

#include <catch2/catch.hpp>

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

using elvis::test::read_file;

namespace {

namespace fs = std::filesystem;

const fs::path api = ELVIS_PLUGIN_API;

/** One fenced block of the page. */
struct Block {
    int step = 0;
    std::string language;
    std::string text;
};

std::vector<Block> read_blocks() {
    std::vector<Block> blocks;
    std::istringstream lines(read_file(api / "tutorial.md"));
    int step = 0;
    bool is_open = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("## Step ", 0) == 0) {
            step = std::stoi(line.substr(8));
        } else if (line.rfind("```", 0) == 0) {
            is_open = !is_open;
            if (is_open) {
                blocks.push_back({step, line.substr(3), {}});
            }
        } else if (is_open) {
            blocks.back().text += line + "\n";
        }
    }
    return blocks;
}

/** Text of all source files of a step. */
std::string sources_of(int step) {
    std::string text;
    for (const auto& entry : fs::recursive_directory_iterator(api / "tutorial" / ("step" + std::to_string(step)))) {
        if (entry.is_regular_file()) {
            text += read_file(entry.path());
        }
    }
    return text;
}

int run(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

} // namespace

TEST_CASE("Every listing of the tutorial is part of its step's files") {
    int n_listings = 0;
    for (const Block& block : read_blocks()) {
        if (block.language != "sh") {
            INFO("step " << block.step << ":\n" << block.text);
            CHECK(sources_of(block.step).find(block.text) != std::string::npos);
            ++n_listings;
        }
    }
    CHECK(n_listings >= 8);
}

TEST_CASE("Every command of the tutorial works, with the files of its step") {
    const fs::path work = fs::path(ELVIS_WORK) / "tutorial";
    fs::remove_all(work);
    fs::create_directories(work);
    REQUIRE(run("'" CMAKE_PROGRAM "' --install '" ELVIS_BUILD "' --prefix '" + (work / "prefix").string() + "' >/dev/null") ==
            0);
    const std::string environment = "export HOME='" + work.string() + "' PATH='" + (work / "prefix/bin").string() +
                                    "':\"$PATH\"; unset XDG_DATA_HOME ELVIS_PLUGIN_PATH; ";
    const fs::path project = work / "my_solver";
    int step = 0;
    for (const Block& block : read_blocks()) {
        if (block.language != "sh") {
            continue;
        }
        for (; step < block.step; ++step) {
            fs::copy(api / "tutorial" / ("step" + std::to_string(step + 1)), project,
                     fs::copy_options::recursive | fs::copy_options::overwrite_existing);
        }
        if (block.step == 0) {
            // It changes the folder in the middle, so it is one command.
            INFO(block.text);
            REQUIRE(run(environment + "cd '" + work.string() + "'; set -e\n" + block.text) == 0);
            continue;
        }
        std::istringstream lines(block.text);
        for (std::string line; std::getline(lines, line);) {
            INFO("step " << block.step << ": " << line);
            REQUIRE(run(environment + "cd '" + project.string() + "' && " + line) == 0);
        }
    }
    CHECK(step == 3);
    for (const char* picture : {"build/picture.png", "step1.png", "step2.png", "step3.png"}) {
        CHECK(fs::exists(project / picture));
    }
}
