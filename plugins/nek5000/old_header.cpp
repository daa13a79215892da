#include "old_header.hpp"

#include "numbers.hpp"

#include <cmath>

namespace elvis_nek5000 {

namespace {

constexpr std::size_t max_code = 30;

struct Numbers {
    std::array<std::optional<std::int64_t>, 4> sizes;
    std::optional<double> time;
};

void add(std::vector<Content>& contents, const Numbers& numbers, std::string_view code) {
    Content content;
    for (std::size_t direction = 0; direction < 3; ++direction) {
        const auto n = numbers.sizes[1 + direction];
        if (!n || *n < 1 || *n > 99) {
            return;
        }
        content.n_nodes[direction] = static_cast<std::uint32_t>(*n);
    }
    const auto blocks = parse_old_code(code);
    if (!numbers.sizes[0] || *numbers.sizes[0] < 1 || *numbers.sizes[0] > 9999999999 || !numbers.time ||
        !std::isfinite(*numbers.time) || !blocks) {
        return;
    }
    content.n_elements = static_cast<std::uint64_t>(*numbers.sizes[0]);
    content.time = *numbers.time;
    content.blocks = *blocks;
    contents.push_back(std::move(content));
}

} // namespace

std::vector<Content> parse_old_header(std::string_view text) {
    const auto integer = [&](std::size_t first, std::size_t n) { return parse_integer(columns(text, first, n)); };
    const auto real = [&](std::size_t first, std::size_t n) { return parse_real(columns(text, first, n)); };
    std::vector<Content> contents;
    // 4i4,1pe14.7,i5,1x,30a1: less than 10000 elements. Numbers may touch.
    add(contents, {{integer(0, 4), integer(4, 4), integer(8, 4), integer(12, 4)}, real(16, 14)}, columns(text, 36, max_code));
    // i10,3i4,1pe18.9,i9,1x,30a1
    add(contents, {{integer(0, 10), integer(10, 4), integer(14, 4), integer(18, 4)}, real(22, 18)},
        columns(text, 50, max_code));
    // i10,3(1x,i2),1x,1pe18.9,1x,i9,1x,a
    add(contents, {{integer(0, 10), integer(10, 3), integer(13, 3), integer(16, 3)}, real(19, 19)},
        columns(text, 49, max_code));
    return contents;
}

} // namespace elvis_nek5000
