#include "part_header.hpp"

#include <elvis/plugin.hpp>

#include <cmath>

namespace elvis_nek5000 {

namespace {

constexpr std::size_t header_size = 132;
constexpr std::size_t mark_size = 4;
/** Of the number of parts in a name. */
constexpr std::int64_t max_parts = 999999;

/** The numbers before the field code. */
struct Numbers {
    std::array<std::optional<std::int64_t>, 6> sizes;
    std::optional<double> time;
    std::array<std::optional<std::int64_t>, 3> places;
};

[[noreturn]] void fail(const ByteFile& file, const std::string& cause) {
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, file.path(), "header: " + cause);
}

std::int64_t in_range(const ByteFile& file, const char* what, std::optional<std::int64_t> value, std::int64_t least,
                      std::int64_t most) {
    if (!value || *value < least || *value > most) {
        fail(file, std::string(what) + (value ? " is " + std::to_string(*value) : " is missing or no number") + "; from " +
                       std::to_string(least) + " to " + std::to_string(most) + " is expected");
    }
    return *value;
}

void set_numbers(const ByteFile& file, const Numbers& numbers, PartHeader& header) {
    constexpr std::int64_t most = 9999999999;
    const std::int64_t real_size = in_range(file, "the size of a number", numbers.sizes[0], 4, 8);
    if (real_size != 4 && real_size != 8) {
        fail(file, "the size of a number is " + std::to_string(real_size) + "; 4 or 8 is expected");
    }
    header.format.real_size = static_cast<std::size_t>(real_size);
    for (std::size_t direction = 0; direction < 3; ++direction) {
        const std::int64_t n = in_range(file, "the number of nodes a direction", numbers.sizes[1 + direction], 1, 99);
        header.content.n_nodes[direction] = static_cast<std::uint32_t>(n);
    }
    header.n_elements =
        static_cast<std::uint64_t>(in_range(file, "the number of elements in this part", numbers.sizes[4], 0, most));
    header.content.n_elements = static_cast<std::uint64_t>(in_range(file, "the number of elements", numbers.sizes[5], 1, most));
    if (!numbers.time || !std::isfinite(*numbers.time)) {
        fail(file, "the time is missing or no number");
    }
    header.content.time = *numbers.time;
    header.n_parts = static_cast<std::uint32_t>(in_range(file, "the number of parts", numbers.places[2], 1, max_parts));
    // Of a single part Neko says that it is part 1.
    const std::int64_t last = header.n_parts == 1 ? max_parts : header.n_parts - 1;
    const std::int64_t part = in_range(file, "the number of this part", numbers.places[1], 0, last);
    header.part = header.n_parts == 1 ? 0 : static_cast<std::uint32_t>(part);
}

/**
 * Whether the header is one of before 2008: the number of parts, the eleventh word, ends in column 75. Later it ends in column
 * 81, or further where programs write wider numbers.
 */
bool is_in_columns(std::string_view text) {
    constexpr std::size_t width = 76;
    constexpr std::string_view digits = "0123456789";
    const std::string_view numbers = columns(text, 0, width), rest = columns(text, width, 1);
    const bool ends_there = numbers.size() == width && digits.find(numbers.back()) != std::string_view::npos &&
                            (rest.empty() || digits.find(rest.front()) == std::string_view::npos);
    return ends_there && words(numbers).size() == 11;
}

/** Columns of before 2008: 4x,i2,3i3,2i10,e20.13,i9,2i6,20a1. */
bool read_columns(const ByteFile& file, std::string_view text, PartHeader& header) {
    if (!is_in_columns(text)) {
        return false;
    }
    const Numbers numbers{
        {parse_integer(columns(text, 4, 2)), parse_integer(columns(text, 6, 3)), parse_integer(columns(text, 9, 3)),
         parse_integer(columns(text, 12, 3)), parse_integer(columns(text, 15, 10)), parse_integer(columns(text, 25, 10))},
        parse_real(columns(text, 35, 20)),
        {parse_integer(columns(text, 55, 9)), parse_integer(columns(text, 64, 6)), parse_integer(columns(text, 70, 6))}};
    const auto blocks = parse_placed_code(columns(text, 76, 20));
    if (!numbers.time || !numbers.places[2] || !blocks) {
        return false;
    }
    set_numbers(file, numbers, header);
    header.content.blocks = *blocks;
    return true;
}

/** Since 2008: words. After the code may come a pressure, a flag and four characters about refinement. */
void read_words(const ByteFile& file, std::string_view text, PartHeader& header) {
    const std::vector<std::string_view> word = words(text);
    const auto at = [&](std::size_t index) { return index < word.size() ? word[index] : std::string_view(); };
    set_numbers(file,
                {{parse_integer(at(1)), parse_integer(at(2)), parse_integer(at(3)), parse_integer(at(4)), parse_integer(at(5)),
                  parse_integer(at(6))},
                 parse_real(at(7)),
                 {parse_integer(at(8)), parse_integer(at(9)), parse_integer(at(10))}},
                header);
    const auto blocks = parse_code(at(11));
    if (!blocks) {
        fail(file, "'" + std::string(at(11)) + "' is no list of fields; letters of X U P T S and two digits are expected");
    }
    header.content.blocks = *blocks;
    const std::size_t flag = parse_real(at(12)) ? 13 : 12;
    header.content.has_gauss_pressure = at(flag) == "T" && header.content.find({Quantity::pressure, 0});
}

} // namespace

std::uint64_t PartHeader::block_place(std::size_t block) const {
    return numbers_place +
           n_elements * (4 + content.n_components_before(block) * content.n_points() * std::uint64_t{format.real_size});
}

bool is_part(const ByteFile& file) { return file.text(0, 4) == "#std"; }

PartHeader read_part_header(const ByteFile& file) {
    const std::string text = file.text(0, header_size + mark_size);
    if (text.size() < header_size + mark_size) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, file.path(),
                                "ends after " + std::to_string(text.size()) + " bytes, within its header");
    }
    PartHeader header;
    const std::string_view letters = std::string_view(text).substr(0, header_size);
    if (!read_columns(file, letters, header)) {
        read_words(file, letters, header);
    }
    if (const std::string cause = refusal(header.content); !cause.empty()) {
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, file.path(), "header: " + cause);
    }
    if (header.n_elements > header.content.n_elements) {
        fail(file, std::to_string(header.n_elements) + " elements in this part, but " +
                       std::to_string(header.content.n_elements) + " in all");
    }
    const auto swapped = is_swapped(text.data() + header_size);
    if (!swapped) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, file.path(),
                                "byte 132: the number 6.54321, which tells the byte order, is not there");
    }
    header.format.is_swapped = *swapped;
    // At most 1e10 elements of 108 components of 31^3 nodes of 8 bytes: no overflow.
    if (const std::uint64_t end = header.block_place(header.content.blocks.size()); end > file.size()) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, file.path(),
                                "has " + std::to_string(file.size()) + " bytes; its header promises " + std::to_string(end));
    }
    return header;
}

} // namespace elvis_nek5000
