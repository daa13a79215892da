/**
 * @file files.hpp
 * Files that tests write and read.
 */
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace elvis::test {

/** An empty folder of its own that goes with this object. */
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return m_path; }
    std::string path(const std::string& name) const { return (m_path / name).string(); }
    /** Writes a file, folders above it included, and returns its path. */
    std::string write(const std::string& name, const std::string& content) const;
    /** Names of the files in it. */
    std::vector<std::string> content() const;

private:
    std::filesystem::path m_path;
};

/** The path of a file of tests/data; fails the test if there is none. */
std::string data_file(const std::string& name);

/** All of a file; fails the test if there is none. */
std::string read_file(const std::filesystem::path& path);

} // namespace elvis::test
