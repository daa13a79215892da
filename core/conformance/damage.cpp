#include <core/conformance/damage.hpp>

#include <core/conformance/random.hpp>

#include <array>
#include <cctype>
#include <cstring>

namespace elvis::conformance {

namespace {

/** Start and length of a run of digits at or behind `from`; length 0 if there is none. */
std::pair<std::size_t, std::size_t> find_number(const std::string& text, std::size_t from) {
    const auto is_digit = [&](std::size_t i) { return std::isdigit(static_cast<unsigned char>(text[i])) != 0; };
    std::size_t begin = from;
    while (begin < text.size() && !is_digit(begin)) {
        ++begin;
    }
    std::size_t end = begin;
    while (end < text.size() && is_digit(end)) {
        ++end;
    }
    return {begin, end - begin};
}

std::string at(std::size_t byte) { return " at byte " + std::to_string(byte); }

} // namespace

Damaged damage(const std::string& content, std::uint64_t seed, std::uint64_t index) {
    Random random(seed * 1000003u + index);
    Damaged damaged{content, "nothing: the file is empty"};
    std::string& text = damaged.content;
    if (text.empty()) {
        return damaged;
    }
    // Half of the damage goes to the first kilobyte, where headers and counts are.
    const std::size_t place =
        random.below(2) == 0 ? random.below(std::min<std::size_t>(text.size(), 1024)) : random.below(text.size());
    switch (random.below(6)) {
    case 0:
        text.resize(place);
        damaged.what = "cut off" + at(place);
        break;
    case 1: {
        const std::size_t count = 1 + random.below(4);
        for (std::size_t i = 0; i < count && place + i < text.size(); ++i) {
            text[place + i] = static_cast<char>(text[place + i] ^ static_cast<char>(1u << random.below(8)));
        }
        damaged.what = "bits flipped" + at(place);
        break;
    }
    case 2: {
        const std::size_t count = std::min<std::size_t>(text.size() - place, 1 + random.below(64));
        std::memset(text.data() + place, random.below(2) == 0 ? 0 : 0xff, count);
        damaged.what = std::to_string(count) + " bytes overwritten" + at(place);
        break;
    }
    case 3: {
        const std::size_t count = std::min<std::size_t>(text.size() - place, 1 + random.below(256));
        text.erase(place, count);
        damaged.what = std::to_string(count) + " bytes left out" + at(place);
        break;
    }
    case 4: {
        const std::size_t count = std::min<std::size_t>(text.size() - place, 1 + random.below(256));
        text.insert(place, text.substr(place, count));
        damaged.what = std::to_string(count) + " bytes repeated" + at(place);
        break;
    }
    default: {
        constexpr std::array<const char*, 8> numbers{
            "-1", "0", "4294967295", "4294967296", "99999999999999999999", "1e400", "nan", "-9223372036854775808"};
        const auto [begin, length] = find_number(text, place);
        const char* number = numbers[random.below(numbers.size())];
        text.replace(std::min(begin, text.size()), length, number);
        damaged.what = std::string("a number replaced by ") + number + at(begin);
        break;
    }
    }
    return damaged;
}

} // namespace elvis::conformance
