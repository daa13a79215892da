/**
 * @file conversion_process.hpp
 * Conversion in a process of its own: this program once more, which may crash, hang or take all memory alone.
 */
#pragma once

#include <core/base/cancel.hpp>

#include <string>
#include <vector>

namespace elvis::commands {

/**
 * Returns the report as elvis_convert gives it. `output`: the descriptor to which the process writes warnings, and plugins
 * whatever they print. Throws Cancelled, or Error naming file, plugin and cause; then nothing is left behind.
 */
std::string convert_apart(const std::vector<std::string>& inputs, const std::string& output_file, const TaskControl& control,
                          int output);

} // namespace elvis::commands
