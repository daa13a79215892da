/**
 * @file chunk_rows.hpp
 * Many rows of a dataset, whose chunks are unpacked and packed by the thread that asks: HDF5 itself does so with one chunk at a
 * time in the whole process, which takes longer than all else when a large volume is opened or written.
 */
#pragma once

#include "hdf5.hpp"

#include <cstddef>
#include <vector>

namespace elvis::native::h5 {

/**
 * Numbers of eight bytes: `count` rows from `start` on along dimension `row_dimension`, one index of dimensions before it, all
 * of those after it. Checksums are checked. Takes the lock itself, to read packed chunks, and lets it go to unpack them.
 *
 * False if there are so few rows that HDF5 with its cache of chunks is better; if the dataset is stored in a way that is not
 * known here; and if anything is wrong with a chunk. Then read_box does it, or says what is wrong.
 */
bool read_chunk_rows(const Handle& dataset, const std::vector<hsize_t>& start, hsize_t count, std::size_t row_dimension,
                     void* data);

/** The first rows of a chunk of which others are still to come. */
struct OpenChunk {
    /** Of the first row; empty if there is none. */
    std::vector<hsize_t> start;
    hsize_t n_rows = 0;
    std::vector<std::byte> rows;
};

/** The chunks that are whole among rows as read_chunk_rows has them, packed, in their order. */
using PackedChunks = std::vector<std::vector<std::byte>>;
PackedChunks pack_chunk_rows(const Handle& dataset, const std::vector<hsize_t>& start, hsize_t count, std::size_t row_dimension,
                             const void* data);

/**
 * Writes rows as read_chunk_rows reads them. Whole chunks are packed here, unless they are in `packed`: shuffled bytes that do
 * not get smaller are stored in the deflated stream as they are, which any HDF5 reads, several times faster. A chunk that ends
 * these rows waits in `open` for the rest of it, if that comes next; of other parts of chunks HDF5 takes care. Takes the lock
 * itself.
 */
void write_chunk_rows(const Handle& dataset, const std::vector<hsize_t>& start, hsize_t count, std::size_t row_dimension,
                      const void* data, hid_t type, const Place& place, OpenChunk& open, const PackedChunks& packed = {});

/** Writes what waits, when nothing else comes. */
void write_open_chunk(const Handle& dataset, std::size_t row_dimension, hid_t type, const Place& place, OpenChunk& open);

} // namespace elvis::native::h5
