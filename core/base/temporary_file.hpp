/**
 * @file temporary_file.hpp
 * Files that last as long as a test.
 */
#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include <unistd.h>

namespace elvis::oracle {

/** A name of its own in the system's temporary folder; the file is removed at the end. */
class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& name)
        : m_path(std::filesystem::temp_directory_path() /
                 ("elvis-" + std::to_string(::getpid()) + "-" + std::to_string(next()) + "-" + name)) {}
    ~TemporaryFile() {
        std::error_code ignored;
        std::filesystem::remove(m_path, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    std::string path() const { return m_path.string(); }

private:
    // Threads may ask for files of one name.
    static unsigned next() {
        static std::atomic<unsigned> count = 0;
        return count++;
    }

    std::filesystem::path m_path;
};

} // namespace elvis::oracle
