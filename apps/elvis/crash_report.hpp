/**
 * @file crash_report.hpp
 * A last word when a plugin crashes the program.
 */
#pragma once

namespace elvis {

/**
 * From now on, a crash (bad memory access, abort, ...) within a plugin's function is announced on stderr with the plugin's id
 * and the function, before the process ends as it would have.
 */
void report_crashes();

/** From now on such a crash is told in one line to this descriptor instead, for the program that started this one. */
void report_crashes_to(int descriptor, char mark);

} // namespace elvis
