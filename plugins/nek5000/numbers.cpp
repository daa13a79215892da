#include "numbers.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

namespace elvis_nek5000 {

namespace {

constexpr std::string_view blanks(" \t\r\n\0", 5);

std::string_view trimmed(std::string_view text) {
    const std::size_t first = std::min(text.find_first_not_of(blanks), text.size());
    text.remove_prefix(first);
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::string_view without_plus(std::string_view text) {
    const bool is_signed = text.size() > 1 && text[0] == '+' && text[1] != '-';
    return text.substr(is_signed ? 1 : 0);
}

template <class Word> Word word_at(const char* bytes, bool is_swapped) {
    Word word = 0;
    std::memcpy(&word, bytes, sizeof word);
    if (is_swapped) {
        if constexpr (sizeof word == 4) {
            word = __builtin_bswap32(word);
        } else {
            word = __builtin_bswap64(word);
        }
    }
    return word;
}

} // namespace

std::string_view columns(std::string_view line, std::size_t first, std::size_t n) {
    return line.substr(std::min(first, line.size()), n);
}

std::vector<std::string_view> words(std::string_view line) {
    std::vector<std::string_view> result;
    for (std::size_t first = line.find_first_not_of(blanks); first != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(blanks, first), line.size());
        result.push_back(line.substr(first, end - first));
        first = line.find_first_not_of(blanks, end);
    }
    return result;
}

std::optional<std::int64_t> parse_integer(std::string_view text) {
    text = without_plus(trimmed(text));
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

std::optional<double> parse_real(std::string_view text) {
    std::string number(without_plus(trimmed(text)));
    for (char& letter : number) {
        letter = letter == 'D' || letter == 'd' ? 'E' : letter;
    }
    // Three digits of the exponent take the letter's place.
    const std::size_t sign = number.find_last_of("+-");
    if (sign != std::string::npos && sign > 0 &&
        (std::isdigit(static_cast<unsigned char>(number[sign - 1])) || number[sign - 1] == '.')) {
        number.insert(sign, 1, 'E');
    }
    double value = 0;
    const char* const last = number.data() + number.size();
    const auto [end, error] = std::from_chars(number.data(), last, value);
    if (error == std::errc::result_out_of_range && end == last) {
        // Smaller than the smallest double, or larger than the largest.
        const std::size_t exponent = number.find_first_of("eE");
        return exponent != std::string::npos && number.find('-', exponent) != std::string::npos ? 0 : HUGE_VAL;
    }
    return error == std::errc{} && end == last ? std::optional(value) : std::nullopt;
}

std::optional<bool> is_swapped(const char* mark) {
    for (const bool swapped : {false, true}) {
        const auto value = std::bit_cast<float>(word_at<std::uint32_t>(mark, swapped));
        // Rounding to single precision, and no number with its bytes exchanged.
        if (std::abs(value - 6.54321F) < 1e-4F) {
            return swapped;
        }
    }
    return std::nullopt;
}

void decode(const ByteFormat& format, const char* bytes, std::span<double> values) {
    if (format.real_size == 4) {
        for (double& value : values) {
            value = static_cast<double>(std::bit_cast<float>(word_at<std::uint32_t>(bytes, format.is_swapped)));
            bytes += 4;
        }
    } else {
        for (double& value : values) {
            value = std::bit_cast<double>(word_at<std::uint64_t>(bytes, format.is_swapped));
            bytes += 8;
        }
    }
}

std::uint32_t decode_integer(const ByteFormat& format, const char* bytes) {
    return word_at<std::uint32_t>(bytes, format.is_swapped);
}

} // namespace elvis_nek5000
