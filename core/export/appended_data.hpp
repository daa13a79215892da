/**
 * @file appended_data.hpp
 * The part of a VTK file that holds its arrays: raw bytes in blocks that zlib has compressed, behind headers of 64-bit
 * integers.
 */
#pragma once

#include <core/base/cancel.hpp>

#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace elvis {

/** Leaves room for an array's offset, which is known when the array is written. Returns where. */
std::streampos reserve_offset(std::ostream& file);
/** Writes there how far the file's end is from where the arrays begin. */
void fill_offset(std::ostream& file, std::streampos place, std::streampos begin);

/**
 * One array, written front to back into an open file. Memory holds one block. Little-endian machines only (asserted at compile
 * time), which is what the file declares.
 */
class AppendedArray {
public:
    /** The array begins where the file's end is and will have that many bytes. */
    AppendedArray(std::ofstream& file, std::uint64_t n_bytes);

    template <class Number> void append(std::span<const Number> numbers) { append_bytes(std::as_bytes(numbers)); }

    /** Writes the last block and the header, which is known only now. All bytes must have been given. */
    void finish();

private:
    void append_bytes(std::span<const std::byte> bytes);
    void write_block();

    std::ofstream& m_file;
    std::streampos m_begin;
    [[maybe_unused]] std::uint64_t m_n_bytes; // Only assertions ask for it.
    std::uint64_t m_n_given = 0;
    std::vector<std::byte> m_block;
    std::vector<unsigned char> m_compressed;
    /** Number of blocks, size of a block, size of a partial last one, then the compressed sizes. */
    std::vector<std::uint64_t> m_header;
    std::size_t m_n_written = 0;
};

} // namespace elvis
