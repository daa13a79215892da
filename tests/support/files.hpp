/**
 * @file files.hpp
 * Files that tests write and read.
 */
#pragma once

#include <core/base/temporary_folder.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace elvis::test {

using elvis::TemporaryFolder;

/** Names of what a folder holds. */
std::vector<std::string> names_in(const TemporaryFolder& folder);

/** The path of a file of tests/data; fails the test if there is none. */
std::string data_file(const std::string& name);

/** All of a file; fails the test if there is none. */
std::string read_file(const std::filesystem::path& path);

} // namespace elvis::test
