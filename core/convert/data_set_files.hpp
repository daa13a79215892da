/**
 * @file data_set_files.hpp
 * Which files a foreign data set may be made of, beside those that the user names.
 */
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

/**
 * A guess: plugins do not tell what they read. The files that are named; text files' own mentions of others, and what these
 * mention; and what lies beside a named file, or in a folder there, and begins as its name does (digits at the end apart):
 * `case0.f00001` has `case.re2` and `case0.f00002`. Pictures and what ElVis writes do not count unless they are named or
 * mentioned; but of an HDF5 file, which may find others by their ids, all HDF5 files beside it do. Sorted, absolute; nothing
 * if there are too many (20000).
 */
std::optional<std::vector<std::filesystem::path>> data_set_files(const std::vector<std::string>& inputs);

} // namespace elvis
