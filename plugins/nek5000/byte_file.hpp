/**
 * @file byte_file.hpp
 * Files that are read at any place, by any thread.
 */
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace elvis_nek5000 {

/** Failures are elvis::api::Error with the file and, where something is missing, its place. */
class ByteFile {
public:
    explicit ByteFile(std::string path);
    ~ByteFile();
    ByteFile(const ByteFile&) = delete;
    ByteFile& operator=(const ByteFile&) = delete;

    const std::string& path() const { return m_path; }
    std::uint64_t size() const { return m_size; }

    /** All n bytes from there, or an Error. */
    void read(std::uint64_t place, char* bytes, std::size_t n) const;
    /** Up to n bytes from there. */
    std::string text(std::uint64_t place, std::size_t n) const;

private:
    std::string m_path;
    int m_descriptor = -1;
    std::uint64_t m_size = 0;
};

/** The files that were opened last stay open: a process may not have all parts of all time steps open at once. */
class OpenFiles {
public:
    std::shared_ptr<const ByteFile> open(const std::string& path);

private:
    std::mutex m_mutex;
    /** The latest first. */
    std::deque<std::shared_ptr<const ByteFile>> m_files;
};

} // namespace elvis_nek5000
