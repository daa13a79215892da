#include "chunk_rows.hpp"

#include "chunk_codec.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <optional>
#include <span>

namespace elvis::native::h5 {

namespace {

/** Numbers in memory are those of the file. */
constexpr bool is_little_endian = std::endian::native == std::endian::little;
/** Read under one lock. */
constexpr hsize_t chunks_at_once = 16;

/** How a dataset is stored. */
struct Layout {
    std::vector<hsize_t> shape, chunk;
    /** In the order in which they were applied. */
    std::vector<H5Z_filter_t> filters;
    std::size_t row_bytes = 0;
    hsize_t rows_a_chunk = 0;

    std::size_t chunk_bytes() const { return row_bytes * static_cast<std::size_t>(rows_a_chunk); }
};

bool read_filters(hid_t list, Layout& layout) {
    const int n_filters = H5Pget_nfilters(list);
    for (int i = 0; i < n_filters; ++i) {
        unsigned flags = 0;
        std::size_t n_values = 0;
        const H5Z_filter_t filter =
            H5Pget_filter2(list, static_cast<unsigned>(i), &flags, &n_values, nullptr, 0, nullptr, nullptr);
        if (filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_DEFLATE && filter != H5Z_FILTER_FLETCHER32) {
            return false;
        }
        layout.filters.push_back(filter);
    }
    return n_filters >= 0;
}

/** None if it is not one that is known here. */
std::optional<Layout> layout_of(const Handle& dataset, std::size_t rank, std::size_t row_dimension) {
    const Handle list(H5Dget_create_plist(dataset.id()), H5Pclose), space(H5Dget_space(dataset.id()), H5Sclose);
    Layout layout;
    layout.shape.resize(rank);
    layout.chunk.resize(rank);
    unsigned options = 0;
    if (H5Sget_simple_extent_dims(space.id(), layout.shape.data(), nullptr) < 0 ||
        H5Pget_chunk(list.id(), static_cast<int>(rank), layout.chunk.data()) != static_cast<int>(rank) ||
        H5Pget_chunk_opts(list.id(), &options) < 0 || options != 0 || !read_filters(list.id(), layout)) {
        return {};
    }
    layout.row_bytes = number_bytes;
    layout.rows_a_chunk = layout.chunk[row_dimension];
    for (std::size_t dimension = 0; dimension < rank; ++dimension) {
        const bool is_behind = dimension > row_dimension;
        layout.row_bytes *= is_behind ? static_cast<std::size_t>(layout.shape[dimension]) : 1;
        if ((dimension < row_dimension && layout.chunk[dimension] != 1) ||
            (is_behind && layout.chunk[dimension] != layout.shape[dimension])) {
            return {};
        }
    }
    return layout;
}

bool read_packed(const Handle& dataset, const std::vector<hsize_t>& offset, const Layout& layout, PackedChunk& chunk) {
    hsize_t size = 0;
    // Packed, numbers take hardly more than unpacked; a file that says so is damaged.
    if (H5Dget_chunk_storage_size(dataset.id(), offset.data(), &size) < 0 || size == 0 ||
        size > 2 * layout.chunk_bytes() + 4096) {
        return false;
    }
    chunk.bytes.resize(static_cast<std::size_t>(size));
    return H5Dread_chunk(dataset.id(), H5P_DEFAULT, offset.data(), &chunk.mask, chunk.bytes.data()) >= 0;
}

bool is_packed_here(const Layout& layout) {
    return is_little_endian &&
           layout.filters == std::vector<H5Z_filter_t>{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE, H5Z_FILTER_FLETCHER32};
}

std::optional<Layout> locked_layout(const Handle& dataset, std::size_t rank, std::size_t row_dimension) {
    const Lock guard;
    return layout_of(dataset, rank, row_dimension);
}

/** Rows of one chunk. */
struct Part {
    hsize_t from, to, chunk;
};

/** Calls visit(part) for the chunks that hold rows first .. end-1. */
template <class Visit> void for_each_part(const Layout& layout, hsize_t first, hsize_t end, Visit visit) {
    const hsize_t rows = layout.rows_a_chunk;
    for (hsize_t chunk = first / rows; chunk * rows < end; ++chunk) {
        visit(Part{std::max(first, chunk * rows), std::min(end, (chunk + 1) * rows), chunk});
    }
}

/** Whether these are all rows of the chunk. */
bool is_whole(const Layout& layout, std::size_t row_dimension, hsize_t from, hsize_t to) {
    return from % layout.rows_a_chunk == 0 && (to % layout.rows_a_chunk == 0 || to == layout.shape[row_dimension]);
}

void write_packed(const Handle& dataset, const std::vector<hsize_t>& offset, const std::vector<std::byte>& packed,
                  const Place& place) {
    const Lock guard;
    check(H5Dwrite_chunk(dataset.id(), H5P_DEFAULT, 0, offset.data(), packed.size(), packed.data()), place,
          "cannot be written");
}

} // namespace

bool read_chunk_rows(const Handle& dataset, const std::vector<hsize_t>& start, hsize_t count, std::size_t row_dimension,
                     void* data) {
    const hsize_t first = start[row_dimension], end = first + count;
    const std::optional<Layout> layout = locked_layout(dataset, start.size(), row_dimension);
    if (!is_little_endian || !layout || count < 2 * layout->rows_a_chunk || end > layout->shape[row_dimension]) {
        return false;
    }
    const hsize_t rows = layout->rows_a_chunk, end_chunk = (end + rows - 1) / rows;
    std::vector<PackedChunk> packed(chunks_at_once);
    Unpacker unpack(layout->filters, layout->chunk_bytes());
    std::vector<std::byte> scratch(layout->chunk_bytes());
    std::vector<hsize_t> offset = start;
    for (hsize_t chunk = first / rows; chunk < end_chunk; chunk += chunks_at_once) {
        const hsize_t n = std::min(chunks_at_once, end_chunk - chunk);
        {
            const Lock guard;
            for (hsize_t i = 0; i < n; ++i) {
                offset[row_dimension] = (chunk + i) * rows;
                if (!read_packed(dataset, offset, *layout, packed[i])) {
                    H5Eclear2(H5E_DEFAULT);
                    return false;
                }
            }
        }
        for (hsize_t i = 0; i < n; ++i) {
            const hsize_t begin = (chunk + i) * rows, from = std::max(first, begin), to = std::min(end, begin + rows);
            const std::span<std::byte> wanted(static_cast<std::byte*>(data) + (from - first) * layout->row_bytes,
                                              (to - from) * layout->row_bytes);
            const std::span<const std::byte> plain = unpack(packed[i], to - from == rows ? wanted : std::span(scratch));
            if (plain.empty()) {
                return false;
            }
            if (plain.data() != wanted.data()) {
                std::memcpy(wanted.data(), plain.data() + (from - begin) * layout->row_bytes, wanted.size());
            }
        }
    }
    return true;
}

PackedChunks pack_chunk_rows(const Handle& dataset, const std::vector<hsize_t>& start, hsize_t count, std::size_t row_dimension,
                             const void* data) {
    PackedChunks chunks;
    if (count == 0) {
        return chunks;
    }
    const std::optional<Layout> layout = locked_layout(dataset, start.size(), row_dimension);
    assert(layout);
    if (!is_packed_here(*layout)) {
        return chunks;
    }
    const hsize_t first = start[row_dimension];
    const auto* const bytes = static_cast<const std::byte*>(data);
    Packer pack(layout->chunk_bytes());
    for_each_part(*layout, first, first + count, [&](const Part& part) {
        if (is_whole(*layout, row_dimension, part.from, part.to)) {
            chunks.push_back(
                pack({bytes + (part.from - first) * layout->row_bytes, (part.to - part.from) * layout->row_bytes}));
        }
    });
    return chunks;
}

void write_open_chunk(const Handle& dataset, std::size_t row_dimension, hid_t type, const Place& place, OpenChunk& open) {
    if (open.start.empty()) {
        return;
    }
    const Lock guard;
    const std::optional<Layout> layout = layout_of(dataset, open.start.size(), row_dimension);
    std::vector<hsize_t> counts(layout->shape);
    std::fill_n(counts.begin(), row_dimension, hsize_t{1});
    counts[row_dimension] = open.n_rows;
    write_box(dataset, type, open.start, counts, open.rows.data(), place);
    open = {};
}

void write_chunk_rows(const Handle& dataset, const std::vector<hsize_t>& start, hsize_t count, std::size_t row_dimension,
                      const void* data, hid_t type, const Place& place, OpenChunk& open, const PackedChunks& packed) {
    if (count == 0) {
        return;
    }
    const std::optional<Layout> layout = locked_layout(dataset, start.size(), row_dimension);
    assert(layout);
    const hsize_t first = start[row_dimension], n_rows = layout->shape[row_dimension];
    if (first > n_rows || count > n_rows - first) {
        place.fail("has " + std::to_string(n_rows) + " rows: " + std::to_string(count) + " from row " + std::to_string(first) +
                   " on cannot be written");
    }
    const auto* const bytes = static_cast<const std::byte*>(data);
    const bool is_packed = is_packed_here(*layout);
    std::optional<Packer> packer;
    const auto pack = [&](std::span<const std::byte> rows) -> const std::vector<std::byte>& {
        return (packer ? *packer : packer.emplace(layout->chunk_bytes()))(rows);
    };
    std::size_t n_whole = 0;
    for_each_part(*layout, first, first + count, [&](const Part& part) {
        const std::span<const std::byte> rows(bytes + (part.from - first) * layout->row_bytes,
                                              (part.to - part.from) * layout->row_bytes);
        std::vector<hsize_t> at = start;
        at[row_dimension] = part.chunk * layout->rows_a_chunk;
        if (is_packed && is_whole(*layout, row_dimension, part.from, part.to)) {
            write_packed(dataset, at, n_whole < packed.size() ? packed[n_whole] : pack(rows), place);
            ++n_whole;
            return;
        }
        const bool is_next = open.start == at && at[row_dimension] + open.n_rows == part.from;
        if (!is_next) {
            write_open_chunk(dataset, row_dimension, type, place, open);
            at[row_dimension] = part.from;
            open.start = at;
        }
        open.rows.insert(open.rows.end(), rows.begin(), rows.end());
        open.n_rows += part.to - part.from;
        if (is_packed && is_whole(*layout, row_dimension, open.start[row_dimension], part.to)) {
            write_packed(dataset, at, pack(open.rows), place);
            open = {};
        }
    });
}

} // namespace elvis::native::h5
