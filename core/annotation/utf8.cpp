#include <core/annotation/utf8.hpp>

#include <array>
#include <cstdint>

namespace elvis {

std::u32string decode_utf8(std::string_view text) {
    constexpr char32_t replacement = 0xFFFD;
    // The least code point that needs one, two or three further bytes.
    constexpr std::array<char32_t, 4> least = {0, 0x80, 0x800, 0x10000};
    std::u32string characters;
    for (std::size_t at = 0; at < text.size();) {
        const auto lead = static_cast<std::uint8_t>(text[at++]);
        if (lead < 0x80) {
            characters.push_back(lead);
            continue;
        }
        const std::size_t n_more = lead >= 0xF0 && lead < 0xF8 ? 3 : lead >= 0xE0 ? 2 : 1;
        if (lead < 0xC0 || lead >= 0xF8) {
            characters.push_back(replacement);
            continue;
        }
        char32_t code = lead & (0x3Fu >> n_more);
        std::size_t read = 0;
        while (read < n_more && at < text.size() && (static_cast<std::uint8_t>(text[at]) & 0xC0) == 0x80) {
            code = (code << 6) | (static_cast<std::uint8_t>(text[at++]) & 0x3Fu);
            ++read;
        }
        const bool is_surrogate = code >= 0xD800 && code < 0xE000;
        const bool is_valid = read == n_more && code >= least[n_more] && code <= 0x10FFFF && !is_surrogate;
        characters.push_back(is_valid ? code : replacement);
    }
    return characters;
}

std::string encode_utf8(std::u32string_view text) {
    std::string bytes;
    for (const char32_t character : text) {
        const int n_more = character < 0x80 ? 0 : character < 0x800 ? 1 : character < 0x10000 ? 2 : 3;
        constexpr unsigned char first[] = {0x00, 0xC0, 0xE0, 0xF0};
        bytes += static_cast<char>(first[n_more] | character >> (6 * n_more));
        for (int i = n_more - 1; i >= 0; --i) {
            bytes += static_cast<char>(0x80 | (character >> (6 * i) & 0x3Fu));
        }
    }
    return bytes;
}

} // namespace elvis
