// A plugin that misbehaves does not take the program down without a word: every message names the plugin.

#include <tests/support/program_folder.hpp>

#include <catch2/catch.hpp>

#include <filesystem>
#include <string>

using namespace elvis::test;

namespace {

/** elvis render of the defective plugin's volume; a crash leaves no core file. */
Outcome render(const std::string& defect, const std::string& scale = "0.75") {
    const ProgramFolder place;
    place.write("volume.defective", "defective 1\n" + scale + "\n");
    const std::string folder = std::filesystem::path(DEFECTIVE_PLUGIN).parent_path().string();
    return place.run("render volume.defective --cut-plane 0,0,1,0 --size 32x32 -o out.png",
                     "ulimit -c 0 && ELVIS_DEFECT='" + defect + "' ELVIS_PLUGIN_PATH='" + folder + "'");
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
