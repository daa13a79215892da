#include "encoding.hpp"

#include <lz4.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>

namespace elvis_vtk {

namespace {

/** Values of the base64 alphabet; 64 for characters outside of it. */
constexpr std::array<unsigned char, 256> make_base64_values() {
    std::array<unsigned char, 256> values{};
    values.fill(64);
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t value = 0; value < alphabet.size(); ++value) {
        values[static_cast<unsigned char>(alphabet[value])] = static_cast<unsigned char>(value);
    }
    return values;
}
constexpr auto base64_values = make_base64_values();

/** Bytes front to back, from raw data or from base64 text. */
class ByteReader {
public:
    ByteReader(std::string_view data, bool is_base64) : m_data(data), m_is_base64(is_base64) {}

    /** No more bytes than this are left. */
    std::size_t at_most_left() const { return m_is_base64 ? m_data.size() / 4 * 3 + 3 + m_n_held : m_data.size(); }

    void read(std::span<unsigned char> out) {
        if (!m_is_base64) {
            if (out.size() > m_data.size()) {
                throw Malformed("the data end in the middle of the array");
            }
            if (!out.empty()) {
                std::memcpy(out.data(), m_data.data(), out.size());
            }
            m_data.remove_prefix(out.size());
            return;
        }
        for (std::size_t at = 0; at < out.size();) {
            if (m_n_held == 0) {
                decode_group();
            }
            const std::size_t n = std::min(m_n_held, out.size() - at);
            std::memcpy(&out[at], &m_held[3 - m_n_held], n);
            m_n_held -= n;
            at += n;
        }
    }

private:
    void decode_group() {
        std::array<unsigned char, 4> digits{};
        std::size_t n_digits = 0, n_padding = 0;
        while (n_digits + n_padding < 4) {
            if (m_data.empty()) {
                throw Malformed("the base64 text ends in the middle of the array");
            }
            const auto character = static_cast<unsigned char>(m_data.front());
            m_data.remove_prefix(1);
            if (character == '=') {
                ++n_padding;
            } else if (base64_values[character] < 64 && n_padding == 0) {
                digits[n_digits++] = base64_values[character];
            } else if (character != ' ' && character != '\n' && character != '\r' && character != '\t') {
                throw Malformed("a character that is not base64");
            }
        }
        if (n_digits < 2) {
            throw Malformed("a base64 group of less than a byte");
        }
        const std::array<unsigned char, 3> bytes{static_cast<unsigned char>(digits[0] << 2 | digits[1] >> 4),
                                                 static_cast<unsigned char>(digits[1] << 4 | digits[2] >> 2),
                                                 static_cast<unsigned char>(digits[2] << 6 | digits[3])};
        // Held at the end, so that what is left always ends there.
        m_n_held = n_digits - 1;
        std::copy_n(bytes.begin(), m_n_held, m_held.end() - static_cast<std::ptrdiff_t>(m_n_held));
    }

    std::string_view m_data;
    bool m_is_base64;
    std::array<unsigned char, 3> m_held{};
    std::size_t m_n_held = 0;
};

std::uint64_t read_header(ByteReader& reader, const Encoding& encoding) {
    std::array<unsigned char, 8> bytes{};
    const std::span<unsigned char> used(bytes.data(), encoding.header_size);
    reader.read(used);
    if (encoding.swap_bytes) {
        std::reverse(used.begin(), used.end());
    }
    if (encoding.header_size == 4) {
        std::uint32_t value = 0;
        std::memcpy(&value, bytes.data(), 4);
        return value;
    }
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data(), 8);
    return value;
}

/** zlib reaches 1032, LZ4 255. */
constexpr std::uint64_t largest_ratio = 1040;

void decompress(Compressor compressor, std::span<const unsigned char> block, std::span<unsigned char> out) {
    if (compressor == Compressor::zlib) {
        auto size = static_cast<uLongf>(out.size());
        if (uncompress(out.data(), &size, block.data(), static_cast<uLong>(block.size())) != Z_OK || size != out.size()) {
            throw Malformed("a block that zlib cannot expand to its size");
        }
        return;
    }
    constexpr std::size_t most = std::numeric_limits<int>::max();
    if (block.size() > most || out.size() > most ||
        LZ4_decompress_safe(reinterpret_cast<const char*>(block.data()), reinterpret_cast<char*>(out.data()),
                            static_cast<int>(block.size()), static_cast<int>(out.size())) != static_cast<int>(out.size())) {
        throw Malformed("a block that LZ4 cannot expand to its size");
    }
}

std::vector<unsigned char> decode_blocks(ByteReader& reader, const Encoding& encoding) {
    const std::uint64_t n_blocks = read_header(reader, encoding);
    const std::uint64_t block_size = read_header(reader, encoding);
    const std::uint64_t last_size = read_header(reader, encoding);
    if (n_blocks == 0) {
        return {};
    }
    if (n_blocks > reader.at_most_left() / encoding.header_size) {
        throw Malformed("the data cannot hold the " + std::to_string(n_blocks) + " blocks of the header");
    }
    std::vector<std::uint64_t> compressed(n_blocks);
    for (std::uint64_t& size : compressed) {
        size = read_header(reader, encoding);
    }
    std::uint64_t total = 0;
    std::uint64_t left = reader.at_most_left();
    for (std::uint64_t block = 0; block < n_blocks; ++block) {
        const std::uint64_t size = block + 1 == n_blocks && last_size > 0 ? last_size : block_size;
        if (compressed[block] > left) {
            throw Malformed("a compressed size of " + std::to_string(compressed[block]) + " bytes where at most " +
                            std::to_string(left) + " are left");
        }
        left -= compressed[block];
        if (size > largest_ratio * (compressed[block] + 1)) {
            throw Malformed("a block of " + std::to_string(compressed[block]) + " bytes cannot expand to " +
                            std::to_string(size));
        }
        total += size;
    }
    std::vector<unsigned char> bytes(total);
    std::vector<unsigned char> packed;
    std::size_t at = 0;
    for (std::uint64_t block = 0; block < n_blocks; ++block) {
        const std::uint64_t size = block + 1 == n_blocks && last_size > 0 ? last_size : block_size;
        packed.resize(compressed[block]);
        reader.read(packed);
        decompress(encoding.compressor, packed, std::span(bytes).subspan(at, size));
        at += size;
    }
    return bytes;
}

} // namespace

std::vector<unsigned char> decode(std::string_view data, bool is_base64, const Encoding& encoding) {
    ByteReader reader(data, is_base64);
    if (encoding.compressor != Compressor::none) {
        return decode_blocks(reader, encoding);
    }
    const std::uint64_t size = read_header(reader, encoding);
    if (size > reader.at_most_left()) {
        throw Malformed("the header announces " + std::to_string(size) + " bytes where at most " +
                        std::to_string(reader.at_most_left()) + " are left");
    }
    std::vector<unsigned char> bytes(size);
    reader.read(bytes);
    return bytes;
}

} // namespace elvis_vtk
