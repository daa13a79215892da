#include "commands.hpp"
#include "crash_report.hpp"
#include "hang_report.hpp"
#include "program_log.hpp"
#include "unknown_word.hpp"

#include <core/base/error.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <vector>

namespace {

/** The first word that is no option is a command. */
void check_command(const CLI::App& app, const std::vector<std::string>& words) {
    const auto first = std::ranges::find_if(words, [](const std::string& word) { return word.empty() || word.front() != '-'; });
    if (first != words.end()) {
        elvis::commands::need_command(app, *first);
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
    elvis::commands::add_completion(app);
    elvis::commands::add_convert(app);
    elvis::commands::add_devices(app);
    elvis::commands::add_export(app);
    elvis::commands::add_extract(app);
    elvis::commands::add_extrema(app);
    elvis::commands::add_help(app);
    elvis::commands::add_info(app);
    elvis::commands::add_integrate(app);
    elvis::commands::add_streamlines(app);
    elvis::commands::add_pathlines(app);
    elvis::commands::add_manual(app);
    elvis::commands::add_new_plugin(app);
    elvis::commands::add_plugins(app);
    elvis::commands::add_probe(app);
    elvis::commands::add_render(app);
    elvis::commands::add_sample(app);
    elvis::commands::add_serve(app);
    elvis::commands::add_version(app);
    elvis::commands::add_view(app);

    const std::vector<std::string> words(argv + 1, argv + argc);
    try {
        check_command(app, words);
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool is_refused = error.get_exit_code() != 0;
        if (const auto unknown = is_refused ? elvis::commands::unknown_option(app, words) : std::nullopt) {
            std::fprintf(stderr, "elvis: %s\n", unknown->c_str());
            return 2;
        }
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

// NOLINTNEXTLINE(bugprone-exception-escape): an exception here is the program's own fault, and is reported as a crash.
int main(int argc, char** argv) {
    elvis::report_crashes();
    elvis::report_hangs();
    return run(argc, argv);
}
