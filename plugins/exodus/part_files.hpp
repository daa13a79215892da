/**
 * @file part_files.hpp
 * Names of the files that a parallel program writes, one a process: NAME.4.0 to NAME.4.3, the last number with as many digits
 * as the first.
 */
#pragma once

#include <string>
#include <vector>

namespace elvis_exodus {

/**
 * The files of a data set: the one that is named; or all parts, if those that are named are parts of one. Errors
 * (elvis::api::Error): a part that is missing, several files that are no parts, parts of several data sets.
 */
std::vector<std::string> part_files(const std::vector<std::string>& paths);

} // namespace elvis_exodus
