// elvis_hunt: searches for pixels that are wrong and do not say so. See --help and README.md.
#include "hunt.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>

int main(int argc, char** argv) {
    elvis::hunt::Options options;
    std::vector<std::string> sums;
    CLI::App app(
        "Random scenes drawn by ElVis and judged pixel by pixel by the oracle: searches for pixels that are wrong and do "
        "not say so. Fails if there are any.");
    app.add_option("scenes", options.scene_files, "Scenes to judge instead of random ones");
    app.add_option("--seed", options.first, "Number of the first random scene");
    app.add_option("--scenes", options.n_scenes, "How many; 0: until the time is over");
    app.add_option("--seconds", options.seconds, "Begin no scene after this time");
    app.add_option("--kinds", options.kinds, "Only these kinds of scenes; others are passed over")->delimiter(',');
    app.add_option("--precision", options.precisions, "float32, float64 or both")
        ->delimiter(',')
        ->check(CLI::IsMember({"float32", "float64"}));
    app.add_option("--size", options.size, "Width and height of pictures, like 200x150");
    app.add_option("--share", options.sharing, "What surfaces take from each other; in turn without")
        ->check(CLI::IsMember({"none", "rows", "depths", "all"}));
    app.add_option("--data", options.files, "Data sets in which random scenes lie, one in four times")
        ->check(CLI::ExistingFile);
    app.add_flag("--split", options.splits,
                 "Judges all volumes also with each class of elements in two, not one in three only");
    app.add_option("--write", options.folder,
                   "Writes scenes that have silent errors or many false alarms, with their volumes, into this folder");
    app.add_option("--json", options.json, "Writes the sums");
    app.add_option("--device", options.device, "Device by name or index");
    app.add_flag("--quiet", options.is_quiet, "Only the sums");
    app.add_option("--sum", sums, "Adds up files that --json wrote, and prints them");
    CLI11_PARSE(app, argc, argv);
    // The plugins of this build, or bundle.
    const auto program = std::filesystem::read_symlink("/proc/self/exe");
    ::setenv("ELVIS_PLUGIN_PATH", (program.parent_path().parent_path() / "lib/elvis/plugins").c_str(), 1);
    try {
        if (!sums.empty())
            return elvis::hunt::print_sum(sums, options.json);
        return elvis::hunt::hunt(options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "elvis_hunt: %s\n", error.what());
        return 1;
    }
}
