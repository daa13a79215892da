#include "mpi_team.hpp"

#include <apps/elvis/commands.hpp>
#include <apps/elvis/crash_report.hpp>
#include <apps/elvis/program_log.hpp>

#include <core/base/error.hpp>
#include <core/vulkan/device_choice.hpp>

#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

namespace {

/** Where a machine has several graphics cards and none is named, each process takes one of them. */
void choose_device_of(const elvis::MpiTeam& team) {
    if (std::getenv("ELVIS_DEVICE") != nullptr) {
        return;
    }
    std::vector<std::string> devices = elvis::named_devices("all");
    if (devices.size() > 1) {
        ::setenv("ELVIS_DEVICE", devices[team.local_rank() % devices.size()].c_str(), 0);
    }
}

/** 0: all was done; 2: wrong usage. Failures do not return: all processes end. */
int run(int argc, char** argv, elvis::MpiTeam& team) {
    CLI::App app{"ElVis on many processes: each draws or converts some parts of the volume", "elvis-mpi"};
    app.set_version_flag("--version", "elvis-mpi " ELVIS_VERSION);
    app.require_subcommand(1);
    bool verbose = false;
    bool quiet = false;
    app.add_flag("-v,--verbose", verbose, "Say more on stderr");
    app.add_flag("-q,--quiet", quiet, "Say nothing but errors on stderr");
    // Runs before the subcommand's callback. What all would say the first says.
    app.parse_complete_callback([&] {
        const bool is_silent = quiet || (!verbose && !team.is_first());
        elvis::set_up_log(verbose ? elvis::Verbosity::verbose : is_silent ? elvis::Verbosity::quiet : elvis::Verbosity::normal);
        choose_device_of(team);
    });
    elvis::commands::add_render(app, &team);
    elvis::commands::add_convert(app, &team);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() != 0) {
            team.fail(error.what(), 2);
        }
        return team.is_first() ? app.exit(error) : 0;
    } catch (const elvis::UsageError& error) {
        team.fail(error.what(), 2);
    } catch (const std::exception& error) {
        team.fail(error.what(), 1);
    }
    return 0;
}

} // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): an exception here is the program's own fault, and is reported as a crash.
int main(int argc, char** argv) {
    const elvis::MpiProgram program(argc, argv);
    elvis::MpiTeam team;
    elvis::report_crashes();
    return run(argc, argv, team);
}
