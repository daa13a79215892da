/**
 * @file program_log.hpp
 * Where the program's log lines go: stderr, so that standard output stays free for answers.
 */
#pragma once

namespace elvis {

enum class Verbosity { quiet, normal, verbose };

/**
 * Sets up the process's logger, the core's included. `normal` shows all but what helps to find errors, `verbose` everything,
 * `quiet` errors; $ELVIS_LOG=verbose|quiet wins.
 */
void set_up_log(Verbosity verbosity);

} // namespace elvis
