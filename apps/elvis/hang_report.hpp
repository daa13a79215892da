/**
 * @file hang_report.hpp
 * A word when a plugin does not return.
 */
#pragma once

namespace elvis {

/**
 * From now on, a plugin's function that reports nothing for a time (10 s, then ten times as long, ...) is named in a warning.
 * It is not stopped: it may only be slow, and no thread can be stopped from outside.
 */
void report_hangs();

} // namespace elvis
