/**
 * @file commands.hpp
 * The subcommands of `elvis`. Each function adds its command with options and the callback that runs it. Callbacks report
 * failure by throwing elvis::Error; main turns it into one line on stderr and the exit status.
 */
#pragma once

#include <CLI/CLI.hpp>

namespace elvis {
class DivisibleTeam;
class Team;
} // namespace elvis

namespace elvis::commands {

void add_bench(CLI::App& app);
void add_check_plugin(CLI::App& app);
void add_compile_snippet(CLI::App& app);
void add_completion(CLI::App& app);
void add_convert(CLI::App& app, Team* team = nullptr);
void add_devices(CLI::App& app);
void add_export(CLI::App& app);
void add_extract(CLI::App& app);
void add_extrema(CLI::App& app);
void add_help(CLI::App& app);
void add_info(CLI::App& app);
void add_integrate(CLI::App& app);
void add_streamlines(CLI::App& app);
void add_pathlines(CLI::App& app);
void add_manual(CLI::App& app);
void add_new_plugin(CLI::App& app);
void add_plugins(CLI::App& app);
void add_probe(CLI::App& app);
/** `team`: the processes that draw parts of a volume together; null: this one draws by itself. It must outlive the command. */
void add_render(CLI::App& app, DivisibleTeam* team = nullptr);
void add_sample(CLI::App& app);
void add_serve(CLI::App& app);
void add_version(CLI::App& app);
void add_view(CLI::App& app);

} // namespace elvis::commands
