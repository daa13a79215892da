#include "packed_data.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <string_view>

namespace nektarpp {

namespace {

constexpr std::array<std::int8_t, 256> digit_values() {
    std::array<std::int8_t, 256> values{};
    values.fill(-1);
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t value = 0; value < digits.size(); ++value) {
        values[static_cast<unsigned char>(digits[value])] = static_cast<std::int8_t>(value);
    }
    return values;
}

std::vector<unsigned char> decode_base64(const XmlFile& file, const pugi::xml_node& node, std::string_view text) {
    static constexpr std::array<std::int8_t, 256> values = digit_values();
    std::vector<unsigned char> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int n_bits = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '=') {
            break;
        }
        if (c == ' ' || c == '\n' || c == '\r' || c == '\t') {
            continue;
        }
        const std::int8_t value = values[static_cast<unsigned char>(c)];
        if (value < 0) {
            file.fail(node, "character " + std::to_string(at + 1) + " of the content is no base64");
        }
        bits = (bits << 6) | static_cast<std::uint32_t>(value);
        n_bits += 6;
        if (n_bits >= 8) {
            n_bits -= 8;
            bytes.push_back(static_cast<unsigned char>(bits >> n_bits));
        }
    }
    return bytes;
}

/** A zlib stream that ends itself whatever happens. */
class Inflater {
public:
    Inflater(const XmlFile& file, const pugi::xml_node& node) : m_file(file), m_node(node) {
        if (inflateInit(&m_stream) != Z_OK) {
            file.fail(node, "zlib cannot be started");
        }
    }
    ~Inflater() { inflateEnd(&m_stream); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    /** Inflates `bytes` into words until the stream ends. */
    std::vector<std::uint64_t> run(std::vector<unsigned char>& bytes, std::uint64_t most) {
        constexpr std::size_t chunk_words = 1u << 15;
        std::vector<std::uint64_t> words;
        std::size_t n_bytes = 0;
        std::size_t n_given = 0;
        int status = Z_OK;
        while (status != Z_STREAM_END) {
            if (words.size() > most) {
                m_file.fail(m_node, "the content holds more than the expected " + std::to_string(most) + " numbers");
            }
            if (words.capacity() - words.size() < chunk_words) {
                words.reserve(std::max(2 * words.capacity(), words.size() + chunk_words));
            }
            words.resize(n_bytes / 8 + chunk_words);
            const std::size_t room = words.size() * 8 - n_bytes;
            if (m_stream.avail_in == 0) {
                const std::size_t part =
                    std::min<std::size_t>(bytes.size() - n_given, std::numeric_limits<unsigned>::max() / 2);
                m_stream.next_in = bytes.data() + n_given;
                m_stream.avail_in = static_cast<uInt>(part);
                n_given += part;
            }
            m_stream.next_out = reinterpret_cast<Bytef*>(words.data()) + n_bytes;
            m_stream.avail_out = static_cast<uInt>(room);
            status = inflate(&m_stream, Z_NO_FLUSH);
            n_bytes += room - m_stream.avail_out;
            if (status != Z_OK && status != Z_STREAM_END) {
                m_file.fail(m_node, std::string("the compressed content is damaged or cut off") +
                                        (m_stream.msg ? std::string(": ") + m_stream.msg : std::string()));
            }
        }
        if (n_bytes % 8 != 0) {
            m_file.fail(m_node, "the content's " + std::to_string(n_bytes) + " bytes are no whole number of 8-byte words");
        }
        words.resize(n_bytes / 8);
        return words;
    }

private:
    const XmlFile& m_file;
    pugi::xml_node m_node;
    z_stream m_stream{};
};

} // namespace

std::vector<std::uint64_t> unpack(const XmlFile& file, const pugi::xml_node& node, std::uint64_t most) {
    std::vector<unsigned char> bytes = decode_base64(file, node, text_of(node));
    if (bytes.empty()) {
        return {};
    }
    std::vector<std::uint64_t> words = Inflater(file, node).run(bytes, most);
    if (words.size() > most) {
        file.fail(node, "the content holds " + std::to_string(words.size()) + " numbers, more than the expected " +
                            std::to_string(most));
    }
    if constexpr (std::endian::native == std::endian::big) {
        for (std::uint64_t& word : words) {
            word = __builtin_bswap64(word);
        }
    }
    return words;
}

} // namespace nektarpp
