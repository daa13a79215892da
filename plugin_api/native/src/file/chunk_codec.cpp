#include "chunk_codec.hpp"

#include <zlib.h>
#ifdef ELVIS_HAS_LIBDEFLATE
#include <libdeflate.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>
#include <utility>

namespace elvis::native::h5 {

namespace {

/** Fast, and on shuffled coefficients within a few percent of the best. */
constexpr int deflate_level = 1;

Bytef* of_zlib(const std::byte* bytes) { return reinterpret_cast<Bytef*>(const_cast<std::byte*>(bytes)); }

/** Fletcher's checksum of 16-bit words, the high byte first, as HDF5 has it: sums modulo 65535. */
std::uint32_t fletcher32(std::span<const std::byte> data) {
    std::uint32_t sum1 = 0, sum2 = 0;
    const auto fold = [](std::uint64_t sum) {
        const std::uint64_t once = (sum & 0xffffu) + (sum >> 16u);
        return static_cast<std::uint32_t>((once & 0xffffu) + (once >> 16u));
    };
    const auto word = [&](std::size_t at) {
        return (std::to_integer<std::uint32_t>(data[at]) << 8u) | std::to_integer<std::uint32_t>(data[at + 1]);
    };
    // So many words, each as often as it is in sum2, do not overflow; sums of known length are vectorized.
    constexpr std::size_t block_words = 256;
    std::size_t at = 0;
    for (; data.size() - at >= 2 * block_words; at += 2 * block_words) {
        std::uint32_t sum = 0, weighted = 0;
        for (std::uint32_t i = 0; i < block_words; ++i) {
            sum += word(at + 2 * i);
            weighted += (static_cast<std::uint32_t>(block_words) - i) * word(at + 2 * i);
        }
        sum2 = fold(std::uint64_t{sum2} + block_words * std::uint64_t{sum1} + weighted);
        sum1 = fold(std::uint64_t{sum1} + sum);
    }
    for (; at < data.size(); at += 2) {
        sum1 = fold(sum1 + (at + 1 < data.size() ? word(at) : std::to_integer<std::uint32_t>(data[at]) << 8u));
        sum2 = fold(sum2 + sum1);
    }
    return (sum2 << 16u) | sum1;
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

void shuffle(std::span<const std::byte> plain, std::span<std::byte> planes) {
    const std::size_t n = plain.size() / number_bytes;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < number_bytes; ++k) {
            planes[k * n + i] = plain[number_bytes * i + k];
        }
    }
}

/** How zlib is to pack a plane: its level, and its strategy. */
struct Way {
    int level, strategy;
};

/** Of bytes: how many come after their like, and how many are the fourth of four that were there before, in shares of them all;
 * and what the others are worth, in bits. */
struct Repetition {
    double runs = 0, fours = 0, bits = 0;
};

Repetition repetition_of(std::span<const std::byte> bytes) {
    std::array<std::uint32_t, 256> counts{};
    std::array<std::uint32_t, 4096> last{};
    std::uint32_t word = 0;
    std::size_t n_runs = 0, n_fours = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const auto byte = std::to_integer<std::uint32_t>(bytes[i]);
        n_runs += i > 0 && byte == (word & 0xffu) ? 1 : 0;
        ++counts[byte];
        word = word << 8u | byte;
        // Knuth's multiplicative hash. The first three are the beginning of zeros.
        std::uint32_t& there = last[word * 2654435761u >> 20u];
        n_fours += i > 2 && there == word ? 1 : 0;
        there = word;
    }
    const auto n = static_cast<double>(bytes.size());
    Repetition result{static_cast<double>(n_runs) / n, static_cast<double>(n_fours) / n, 0};
    for (const std::uint32_t count : counts) {
        result.bits += count > 0 ? count / n * std::log2(n / count) : 0;
    }
    return result;
}

/** As the beginning of the plane shows: to try it out with zlib takes as long as packing it. */
Way way_of(std::span<const std::byte> plane) {
    constexpr std::size_t least = 1024;
    // Less than a quarter is not worth the time of unpacking.
    constexpr double small_enough = 0.75;
    // Runs alone are found in half of the time that other repetitions take.
    constexpr double few = 0.1;
    if (plane.size() < least) {
        return {deflate_level, Z_DEFAULT_STRATEGY};
    }
    const Repetition found = repetition_of(plane.first(std::max(least, plane.size() / 8)));
    if ((1 - found.fours) * found.bits >= 8 * small_enough) {
        return {Z_NO_COMPRESSION, Z_DEFAULT_STRATEGY};
    }
    return {deflate_level, found.fours > found.runs + few ? Z_DEFAULT_STRATEGY : Z_RLE};
}

} // namespace

#ifdef ELVIS_HAS_LIBDEFLATE
/** libdeflate takes less than half of the time of zlib. */
class Unpacker::Inflater {
public:
    Inflater() : m_decompressor(libdeflate_alloc_decompressor()) {
        if (m_decompressor == nullptr) {
            throw std::bad_alloc();
        }
    }
    ~Inflater() { libdeflate_free_decompressor(m_decompressor); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    /** Whether it is as long as `out`, and good. */
    bool operator()(std::span<const std::byte> packed, std::span<std::byte> out) {
        return libdeflate_zlib_decompress(m_decompressor, packed.data(), packed.size(), out.data(), out.size(), nullptr) ==
               LIBDEFLATE_SUCCESS;
    }

private:
    libdeflate_decompressor* m_decompressor;
};
#else
class Unpacker::Inflater {
public:
    /** Whether it is as long as `out`, and good. */
    bool operator()(std::span<const std::byte> packed, std::span<std::byte> out) {
        uLongf size = static_cast<uLongf>(out.size());
        return uncompress(of_zlib(out.data()), &size, of_zlib(packed.data()), static_cast<uLong>(packed.size())) == Z_OK &&
               size == out.size();
    }
};
#endif

Unpacker::Unpacker(std::vector<H5Z_filter_t> filters, std::size_t chunk_bytes)
    : m_filters(std::move(filters)), m_inflated(chunk_bytes), m_inflater(std::make_unique<Inflater>()) {}

Unpacker::~Unpacker() = default;

std::span<const std::byte> Unpacker::operator()(const PackedChunk& chunk, std::span<std::byte> plain) {
    std::span<const std::byte> data(chunk.bytes);
    for (std::size_t filter = m_filters.size(); filter-- > 0;) {
        if ((chunk.mask >> filter & 1u) == 0 && !undo(m_filters[filter], data, plain)) {
            return {};
        }
    }
    return data.size() == m_inflated.size() ? data : std::span<const std::byte>();
}

bool Unpacker::undo(H5Z_filter_t filter, std::span<const std::byte>& data, std::span<std::byte> plain) {
    if (filter == H5Z_FILTER_FLETCHER32) {
        const auto content = checked(data);
        data = content.value_or(std::span<const std::byte>());
        return content.has_value();
    }
    if (filter == H5Z_FILTER_DEFLATE) {
        const bool is_good = data.data() != m_inflated.data() && (*m_inflater)(data, m_inflated);
        data = m_inflated;
        return is_good;
    }
    const bool is_whole = data.size() == plain.size() && data.data() != plain.data();
    if (is_whole) {
        unshuffle(data, plain);
    }
    data = plain;
    return is_whole;
}

/** A deflating stream of zlib. */
class Packer::Deflater {
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
        // Each change of the way ends a block.
        out.resize(before + deflateBound(&m_stream, static_cast<uLong>(planes.size())) + 64 * number_bytes);
        deflateReset(&m_stream);
        m_stream.next_out = of_zlib(out.data() + before);
        m_stream.avail_out = static_cast<uInt>(out.size() - before);
        for (std::size_t k = 0; k < number_bytes; ++k) {
            const auto plane = planes.subspan(k * n, n);
            const Way way = way_of(plane);
            m_stream.next_in = nullptr;
            m_stream.avail_in = 0;
            deflateParams(&m_stream, way.level, way.strategy);
            m_stream.next_in = of_zlib(plane.data());
            m_stream.avail_in = static_cast<uInt>(plane.size());
            deflate(&m_stream, k + 1 < number_bytes ? Z_NO_FLUSH : Z_FINISH);
        }
        out.resize(out.size() - m_stream.avail_out);
    }

private:
    z_stream m_stream{};
};

Packer::Packer(std::size_t chunk_bytes)
    : m_plain(chunk_bytes), m_planes(chunk_bytes), m_deflater(std::make_unique<Deflater>()) {}

Packer::~Packer() = default;

const std::vector<std::byte>& Packer::operator()(std::span<const std::byte> rows) {
    std::memcpy(m_plain.data(), rows.data(), rows.size());
    std::fill(m_plain.begin() + static_cast<std::ptrdiff_t>(rows.size()), m_plain.end(), std::byte{0});
    shuffle(m_plain, m_planes);
    m_packed.clear();
    (*m_deflater)(m_planes, m_packed);
    const std::uint32_t sum = fletcher32(m_packed);
    for (unsigned byte = 0; byte < 4; ++byte) {
        m_packed.push_back(static_cast<std::byte>(sum >> (8 * byte) & 0xffu));
    }
    return m_packed;
}

} // namespace elvis::native::h5
