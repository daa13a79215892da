/**
 * @file chunk_codec.hpp
 * The filters of HDF5's chunks: numbers of eight bytes, shuffled, deflated, checksummed.
 */
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace elvis::native::h5 {

inline constexpr std::size_t number_bytes = 8;

/** A chunk as it lies in the file. */
struct PackedChunk {
    std::vector<std::byte> bytes;
    /** Filters that were left out, a bit each. */
    std::uint32_t mask = 0;
};

/** Unpacks chunks of one dataset one after the other. */
class Unpacker {
public:
    /** `filters`: those of H5Z_FILTER_SHUFFLE, _DEFLATE and _FLETCHER32 that there are, in the order in which they were
     * applied. */
    Unpacker(std::vector<H5Z_filter_t> filters, std::size_t chunk_bytes);
    ~Unpacker();

    /**
     * All of it, or nothing if something is wrong with it, its checksum for example. It lies in `plain`, which has a chunk's
     * bytes, or, where numbers were not shuffled, elsewhere, and is good until the next one.
     */
    std::span<const std::byte> operator()(const PackedChunk& chunk, std::span<std::byte> plain);

private:
    class Inflater;
    bool undo(H5Z_filter_t filter, std::span<const std::byte>& data, std::span<std::byte> plain);

    std::vector<H5Z_filter_t> m_filters;
    std::vector<std::byte> m_inflated;
    std::unique_ptr<Inflater> m_inflater;
};

/** Packs chunks of shuffled, deflated, checksummed numbers. */
class Packer {
public:
    explicit Packer(std::size_t chunk_bytes);
    ~Packer();

    /** `rows`: of the last chunk there may be fewer than a chunk holds. It is good until the next one. */
    const std::vector<std::byte>& operator()(std::span<const std::byte> rows);

private:
    class Deflater;
    std::vector<std::byte> m_plain, m_planes, m_packed;
    std::unique_ptr<Deflater> m_deflater;
};

} // namespace elvis::native::h5
