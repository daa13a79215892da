#include "commands.hpp"
#include "crash_report.hpp"
#include "hang_report.hpp"

#include <core/base/error.hpp>
#include <core/base/log.hpp>
#include <core/scene/json_reader.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace {

/** The first word that is no option, where a command should stand. */
void check_command(const CLI::App& app, int argc, char** argv) {
    std::vector<std::string> known;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        known.push_back(command->get_name());
    }
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word.empty() || word.front() != '-') {
            if (std::ranges::find(known, word) == known.end()) {
                throw elvis::UsageError(word, "is no command; the nearest is '" + elvis::nearest_word(word, known) +
                                                  "', and elvis --help lists all");
            }
            return;
        }
    }
}

/** 0: all was done; 2: wrong usage; 1: anything else. */
int run(int argc, char** argv) {
    CLI::App app{"ElVis, the Element Visualizer: pixel-exact pictures of high-order finite element fields", "elvis"};
    app.set_version_flag("--version", "elvis " ELVIS_VERSION);
    app.require_subcommand(1);
    bool verbose = false;
    bool quiet = false;
    app.add_flag("-v,--verbose", verbose, "Say more on stderr");
    app.add_flag("-q,--quiet", quiet, "Say nothing but errors on stderr");
    // Runs before the subcommand's callback.
    app.parse_complete_callback([&] {
        elvis::set_up_log(verbose ? elvis::Verbosity::verbose : quiet ? elvis::Verbosity::quiet : elvis::Verbosity::normal);
    });

    elvis::commands::add_bench(app);
    elvis::commands::add_check_plugin(app);
    elvis::commands::add_compile_snippet(app);
    elvis::commands::add_convert(app);
    elvis::commands::add_devices(app);
    elvis::commands::add_export(app);
    elvis::commands::add_info(app);
    elvis::commands::add_new_plugin(app);
    elvis::commands::add_plugins(app);
    elvis::commands::add_probe(app);
    elvis::commands::add_render(app);
    elvis::commands::add_view(app);

    try {
        check_command(app, argc, argv);
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const elvis::UsageError& error) {
        std::fprintf(stderr, "elvis: %s\n", error.what());
        return 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "elvis: %s\n", error.what());
        return 1;
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    elvis::report_crashes();
    elvis::report_hangs();
    return run(argc, argv);
}
