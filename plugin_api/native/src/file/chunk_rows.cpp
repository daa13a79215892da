#include "chunk_rows.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <optional>
#include <span>

namespace elvis::native::h5 {

namespace {

constexpr std::size_t number_bytes = 8;
/** Numbers in memory are those of the file. */
constexpr bool is_little_endian = std::endian::native == std::endian::little;
/** Fast, and on shuffled coefficients within a few percent of the best. */
constexpr int deflate_level = 1;
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

/** As it lies in the file. */
struct PackedChunk {
    std::vector<std::byte> bytes;
    /** Filters that were left out, a bit each. */
    std::uint32_t mask = 0;
};

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

/** Fletcher's checksum of 16-bit words, the high byte first, as HDF5 has it: sums modulo 65535. */
std::uint32_t fletcher32(std::span<const std::byte> data) {
    std::uint32_t sum1 = 0, sum2 = 0;
    const auto fold = [](std::uint32_t sum) { return (sum & 0xffffu) + (sum >> 16u); };
    std::size_t n_words = data.size() / 2, at = 0;
    while (n_words > 0) {
        // So many additions do not overflow.
        std::size_t n = std::min<std::size_t>(n_words, 360);
        n_words -= n;
        for (; n > 0; --n, at += 2) {
            sum1 += (std::to_integer<std::uint32_t>(data[at]) << 8u) | std::to_integer<std::uint32_t>(data[at + 1]);
            sum2 += sum1;
        }
        sum1 = fold(sum1);
        sum2 = fold(sum2);
    }
    if (data.size() % 2 != 0) {
        sum1 += std::to_integer<std::uint32_t>(data[at]) << 8u;
        sum2 += sum1;
        sum1 = fold(sum1);
        sum2 = fold(sum2);
    }
    return (fold(sum2) << 16u) | fold(sum1);
}

/** Without its checksum; none if that is wrong. */
std::optional<std::span<const std::byte>> checked(std::span<const std::byte> data) {
    std::array<std::uint8_t, 4> stored{};
    if (data.size() < stored.size()) {
        return {};
    }
    const auto content = data.first(data.size() - stored.size());
    std::memcpy(stored.data(), data.data() + content.size(), stored.size());
    const std::uint32_t sum =
        stored[0] | std::uint32_t{stored[1]} << 8u | std::uint32_t{stored[2]} << 16u | std::uint32_t{stored[3]} << 24u;
    return fletcher32(content) == sum ? std::optional(content) : std::nullopt;
}

bool inflated(std::span<const std::byte> packed, std::span<std::byte> out) {
    uLongf size = static_cast<uLongf>(out.size());
    return uncompress(reinterpret_cast<Bytef*>(out.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                      static_cast<uLong>(packed.size())) == Z_OK &&
           size == out.size();
}

/** Byte k of all numbers lies together, for each k. */
void unshuffle(std::span<const std::byte> planes, std::span<std::byte> out) {
    const std::size_t n = planes.size() / number_bytes;
    for (std::size_t i = 0; i < n; ++i) {
        std::uint64_t number = 0;
        for (std::size_t k = 0; k < number_bytes; ++k) {
            number |= std::to_integer<std::uint64_t>(planes[k * n + i]) << (8 * k);
        }
        std::memcpy(out.data() + number_bytes * i, &number, number_bytes);
    }
}

/** Unpacks chunks of one layout one after the other. */
class Unpacker {
public:
    explicit Unpacker(const Layout& layout)
        : m_layout(layout), m_inflated(layout.chunk_bytes()), m_plain(layout.chunk_bytes()) {}

    /** All of it; nothing if something is wrong. It is good until the next one. */
    std::span<const std::byte> operator()(const PackedChunk& chunk) {
        std::span<const std::byte> data(chunk.bytes);
        for (std::size_t filter = m_layout.filters.size(); filter-- > 0;) {
            if ((chunk.mask >> filter & 1u) == 0 && !undo(m_layout.filters[filter], data)) {
                return {};
            }
        }
        return data.size() == m_layout.chunk_bytes() ? data : std::span<const std::byte>();
    }

private:
    bool undo(H5Z_filter_t filter, std::span<const std::byte>& data) {
        if (filter == H5Z_FILTER_FLETCHER32) {
            const auto content = checked(data);
            data = content.value_or(std::span<const std::byte>());
            return content.has_value();
        }
        if (filter == H5Z_FILTER_DEFLATE) {
            const bool is_good = inflated(data, m_inflated);
            data = m_inflated;
            return is_good;
        }
        const bool is_whole = data.size() == m_plain.size() && data.data() != m_plain.data();
        if (is_whole) {
            unshuffle(data, m_plain);
        }
        data = m_plain;
        return is_whole;
    }

    const Layout& m_layout;
    std::vector<std::byte> m_inflated, m_plain;
};

void shuffle(std::span<const std::byte> plain, std::span<std::byte> planes) {
    const std::size_t n = plain.size() / number_bytes;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < number_bytes; ++k) {
            planes[k * n + i] = plain[number_bytes * i + k];
        }
    }
}

/** A deflating stream of zlib. */
class Deflater {
public:
    Deflater() {
        if (deflateInit(&m_stream, deflate_level) != Z_OK) {
            throw std::bad_alloc();
        }
    }
    ~Deflater() { deflateEnd(&m_stream); }
    Deflater(const Deflater&) = delete;
    Deflater& operator=(const Deflater&) = delete;

    /** `planes`: shuffled numbers. Appends to `out`. */
    void operator()(std::span<const std::byte> planes, std::vector<std::byte>& out) {
        const std::size_t n = planes.size() / number_bytes, before = out.size();
        // Each change of the level ends a block.
        out.resize(before + deflateBound(&m_stream, static_cast<uLong>(planes.size())) + 64 * number_bytes);
        deflateReset(&m_stream);
        m_stream.next_out = reinterpret_cast<Bytef*>(out.data() + before);
        m_stream.avail_out = static_cast<uInt>(out.size() - before);
        for (std::size_t k = 0; k < number_bytes; ++k) {
            const auto plane = planes.subspan(k * n, n);
            m_stream.next_in = nullptr;
            m_stream.avail_in = 0;
            deflateParams(&m_stream, gets_smaller(plane) ? deflate_level : Z_NO_COMPRESSION, Z_DEFAULT_STRATEGY);
            m_stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(plane.data()));
            m_stream.avail_in = static_cast<uInt>(plane.size());
            deflate(&m_stream, k + 1 < number_bytes ? Z_NO_FLUSH : Z_FINISH);
        }
        out.resize(out.size() - m_stream.avail_out);
    }

private:
    /** By more than a quarter, as a part of it shows: less is not worth the time of unpacking. */
    static bool gets_smaller(std::span<const std::byte> plane) {
        constexpr std::size_t least = 1024;
        if (plane.size() < least) {
            return true;
        }
        const auto sample = plane.first(std::max(least, plane.size() / 4));
        uLongf size = compressBound(static_cast<uLong>(sample.size()));
        thread_local std::vector<Bytef> scratch;
        scratch.resize(size);
        compress2(scratch.data(), &size, reinterpret_cast<const Bytef*>(sample.data()), static_cast<uLong>(sample.size()),
                  deflate_level);
        return size < sample.size() / 4 * 3;
    }

    z_stream m_stream{};
};

/** Packs chunks of shuffled, deflated, checksummed numbers. */
class Packer {
public:
    explicit Packer(const Layout& layout) : m_plain(layout.chunk_bytes()), m_planes(layout.chunk_bytes()) {}

    /** `rows`: of the last chunk there may be fewer than a chunk holds. It is good until the next one. */
    const std::vector<std::byte>& operator()(std::span<const std::byte> rows) {
        std::memcpy(m_plain.data(), rows.data(), rows.size());
        std::fill(m_plain.begin() + static_cast<std::ptrdiff_t>(rows.size()), m_plain.end(), std::byte{0});
        shuffle(m_plain, m_planes);
        m_packed.clear();
        m_deflate(m_planes, m_packed);
        const std::uint32_t sum = fletcher32(m_packed);
        for (unsigned byte = 0; byte < 4; ++byte) {
            m_packed.push_back(static_cast<std::byte>(sum >> (8 * byte) & 0xffu));
        }
        return m_packed;
    }

private:
    std::vector<std::byte> m_plain, m_planes, m_packed;
    Deflater m_deflate;
};

bool is_packed_here(const Layout& layout) {
    return is_little_endian &&
           layout.filters == std::vector<H5Z_filter_t>{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE, H5Z_FILTER_FLETCHER32};
}

} // namespace

bool read_chunk_rows(const Handle& dataset, const std::vector<hsize_t>& start, hsize_t count, std::size_t row_dimension,
                     void* data) {
    const hsize_t first = start[row_dimension], end = first + count;
    std::optional<Layout> layout;
    {
        const Lock guard;
        layout = layout_of(dataset, start.size(), row_dimension);
    }
    if (!is_little_endian || !layout || count < 2 * layout->rows_a_chunk || end > layout->shape[row_dimension]) {
        return false;
    }
    const hsize_t rows = layout->rows_a_chunk, end_chunk = (end + rows - 1) / rows;
    std::vector<PackedChunk> packed(chunks_at_once);
    Unpacker unpack(*layout);
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
            const std::span<const std::byte> plain = unpack(packed[i]);
            if (plain.empty()) {
                return false;
            }
            const hsize_t from = std::max(first, (chunk + i) * rows), to = std::min(end, (chunk + i + 1) * rows);
            std::memcpy(static_cast<std::byte*>(data) + (from - first) * layout->row_bytes,
                        plain.data() + (from - (chunk + i) * rows) * layout->row_bytes, (to - from) * layout->row_bytes);
        }
    }
    return true;
}

void write_chunk_rows(const Handle& dataset, const std::vector<hsize_t>& start, hsize_t count, std::size_t row_dimension,
                      const void* data, hid_t type, const Place& place) {
    if (count == 0) {
        return;
    }
    std::optional<Layout> layout;
    {
        const Lock guard;
        layout = layout_of(dataset, start.size(), row_dimension);
    }
    const hsize_t first = start[row_dimension], end = first + count;
    hsize_t first_chunk = 0, end_chunk = 0, rows = 1;
    assert(layout);
    if (is_packed_here(*layout)) {
        rows = layout->rows_a_chunk;
        first_chunk = (first + rows - 1) / rows;
        end_chunk = end == layout->shape[row_dimension] ? (end + rows - 1) / rows : end / rows;
    }
    const auto* const bytes = static_cast<const std::byte*>(data);
    const auto write_part = [&](hsize_t from, hsize_t to) {
        if (from < to) {
            const Lock guard;
            std::vector<hsize_t> at = start, counts(layout->shape);
            std::fill_n(counts.begin(), row_dimension, hsize_t{1});
            at[row_dimension] = from;
            counts[row_dimension] = to - from;
            write_box(dataset, type, at, counts, bytes + (from - first) * layout->row_bytes, place);
        }
    };
    if (first_chunk >= end_chunk) {
        write_part(first, end);
        return;
    }
    write_part(first, first_chunk * rows);
    Packer pack(*layout);
    std::vector<hsize_t> offset = start;
    for (hsize_t chunk = first_chunk; chunk < end_chunk; ++chunk) {
        const hsize_t from = chunk * rows, to = std::min(end, from + rows);
        const std::vector<std::byte>& packed =
            pack({bytes + (from - first) * layout->row_bytes, static_cast<std::size_t>(to - from) * layout->row_bytes});
        offset[row_dimension] = from;
        const Lock guard;
        check(H5Dwrite_chunk(dataset.id(), H5P_DEFAULT, 0, offset.data(), packed.size(), packed.data()), place,
              "cannot be written");
    }
    write_part(std::max(first, end_chunk * rows), end);
}

} // namespace elvis::native::h5
