/**
 * @file scratch.hpp
 * Files that checks write, and deterministic random numbers.
 */
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace elvis::conformance {

/** A folder of its own below the system's temporary folder, removed at the end. */
class ScratchFolder {
public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    std::string path(const std::string& name) const { return (m_folder / name).string(); }
    /** Writes a file; returns its path. */
    std::string write(const std::string& name, const std::string& content) const;

private:
    std::filesystem::path m_folder;
};

std::string read_whole_file(const std::string& path);

/** splitmix64 (Steele, Lea, Flood 2014): the same numbers on every machine. */
class Random {
public:
    explicit Random(std::uint64_t seed) : m_state(seed) {}
    std::uint64_t next();
    /** 0 .. n-1 (n > 0); the bias of the remainder is of no matter here. */
    std::uint64_t below(std::uint64_t n) { return next() % n; }
    double uniform(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53; }

private:
    std::uint64_t m_state;
};

std::string random_bytes(std::size_t count, std::uint64_t seed);

} // namespace elvis::conformance
