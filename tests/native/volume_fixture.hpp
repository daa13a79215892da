/**
 * @file volume_fixture.hpp
 * Volumes in memory with random content, to be written, read back and compared.
 */
#pragma once

#include <elvis/native/volume_file.hpp>
#include <tests/support/files.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace elvis::native {

/** All numbers of a volume. */
struct VolumeData {
    Description description;
    std::vector<std::vector<double>> geometry;      // by class
    std::vector<std::vector<std::int64_t>> numbers; // by class
    /** By field, time step, class. */
    std::vector<std::vector<std::vector<std::vector<double>>>> fields;
    std::vector<Face> faces;
};

/** Four shapes, several orders and bases, scalar and vector fields, NaN and infinity, two time steps, groups and notes. */
VolumeData large_volume();
/** Two classes of a few elements and one field: a file of a few kilobytes. */
VolumeData small_volume();

/** Writes all blocks but does not commit. */
void write_blocks(Writer& writer, const VolumeData& data);
void write(const std::string& path, const VolumeData& data, std::span<const std::uint32_t> parts = {});
/** Opens a file and reads all there is. */
VolumeData read_all(const std::string& path);

/** Whether both are the same, bit by bit. */
bool identical(const VolumeData& a, const VolumeData& b);

using test::names_in;
using test::TemporaryFolder;

std::vector<char> read_bytes(const std::string& path);
void write_bytes(const std::string& path, const std::vector<char>& bytes);

} // namespace elvis::native
