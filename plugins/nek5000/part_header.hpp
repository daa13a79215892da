/**
 * @file part_header.hpp
 * Header of a part of a file set, NAME0.f00001.
 */
#pragma once

#include "byte_file.hpp"
#include "field_code.hpp"
#include "numbers.hpp"

namespace elvis_nek5000 {

struct PartHeader {
    Content content;
    ByteFormat format;
    /** In this part. */
    std::uint64_t n_elements = 0;
    std::uint32_t part = 0;
    std::uint32_t n_parts = 1;

    /** Where the global numbers of the elements are. */
    static constexpr std::uint64_t numbers_place = 136;
    /** Where the numbers of a block begin, or, past the last one, where they end. */
    std::uint64_t block_place(std::size_t block) const;
};

bool is_part(const ByteFile& file);

/** Sizes are checked against the file's: what the header promises is there. */
PartHeader read_part_header(const ByteFile& file);

} // namespace elvis_nek5000
