#include "field_code.hpp"

#include <elvis/native/space.hpp>

#include <algorithm>

namespace elvis_nek5000 {

namespace {

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

std::uint32_t digit(char letter) { return static_cast<std::uint32_t>(letter - '0'); }

std::optional<Quantity> quantity_of(char letter) {
    switch (letter) {
    case 'X':
        return Quantity::coordinates;
    case 'U':
        return Quantity::velocity;
    case 'P':
        return Quantity::pressure;
    case 'T':
        return Quantity::temperature;
    default:
        return std::nullopt;
    }
}

/** Blocks stand in the order X U P T S in all files; none comes twice. */
bool is_in_order(const std::vector<Block>& blocks) {
    return std::ranges::adjacent_find(blocks, [](const Block& a, const Block& b) {
               return a.quantity > b.quantity || (a.quantity == b.quantity && a.scalar >= b.scalar);
           }) == blocks.end();
}

std::optional<std::vector<Block>> checked(std::vector<Block> blocks) {
    return is_in_order(blocks) ? std::optional(std::move(blocks)) : std::nullopt;
}

} // namespace

std::string name(const Block& block) {
    switch (block.quantity) {
    case Quantity::coordinates:
        return "coordinates";
    case Quantity::velocity:
        return "velocity";
    case Quantity::pressure:
        return "pressure";
    case Quantity::temperature:
        return "temperature";
    default:
        return (block.scalar < 10 ? "S0" : "S") + std::to_string(block.scalar);
    }
}

std::optional<std::vector<Block>> parse_code(std::string_view code) {
    std::vector<Block> blocks;
    for (std::size_t at = 0; at < code.size(); ++at) {
        if (const auto quantity = quantity_of(code[at])) {
            blocks.push_back({*quantity, 0});
            continue;
        }
        if (code[at] != 'S' || at + 3 != code.size() || !is_digit(code[at + 1]) || !is_digit(code[at + 2])) {
            return std::nullopt;
        }
        const std::uint32_t n_scalars = 10 * digit(code[at + 1]) + digit(code[at + 2]);
        for (std::uint32_t scalar = 1; scalar <= n_scalars; ++scalar) {
            blocks.push_back({Quantity::scalar, scalar});
        }
        break;
    }
    return checked(std::move(blocks));
}

std::optional<std::vector<Block>> parse_old_code(std::string_view code) {
    std::string letters(code);
    std::erase(letters, ' ');
    if (const auto blocks = parse_code(letters)) {
        return blocks;
    }
    std::vector<Block> blocks;
    for (const char letter : letters) {
        if (const auto quantity = quantity_of(letter)) {
            blocks.push_back({*quantity, 0});
        } else if (is_digit(letter) && letter != '0') {
            blocks.push_back({Quantity::scalar, digit(letter)});
        } else if ((letter != 'Y' && letter != 'Z') || blocks.empty() || blocks.back().quantity != Quantity::coordinates) {
            return std::nullopt;
        }
    }
    return checked(std::move(blocks));
}

std::optional<std::vector<Block>> parse_placed_code(std::string_view code) {
    constexpr std::string_view letters = "XUPT";
    std::vector<Block> blocks;
    for (std::size_t at = 0; at < code.size(); ++at) {
        if (code[at] == ' ') {
            continue;
        }
        if (at < letters.size() && code[at] != letters[at]) {
            return std::nullopt;
        }
        const Block scalar{Quantity::scalar, static_cast<std::uint32_t>(at + 1 - letters.size())};
        blocks.push_back(at < letters.size() ? Block{*quantity_of(code[at]), 0} : scalar);
    }
    return blocks;
}

std::size_t Content::n_components_before(std::size_t block) const {
    std::size_t sum = 0;
    for (std::size_t index = 0; index < block; ++index) {
        sum += n_components(blocks[index]);
    }
    return sum;
}

std::optional<std::size_t> Content::find(const Block& block) const {
    const auto found = std::ranges::find(blocks, block);
    return found == blocks.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - blocks.begin()));
}

std::size_t Content::corner_node(std::size_t corner) const {
    const auto end = [&](std::size_t direction) { return (corner >> direction & 1) != 0 ? n_nodes[direction] - 1u : 0u; };
    return end(0) + std::size_t{n_nodes[0]} * (end(1) + std::size_t{n_nodes[1]} * end(2));
}

std::string refusal(const Content& content) {
    const auto& n = content.n_nodes;
    for (std::uint32_t direction = 0; direction < content.dimension(); ++direction) {
        if (n[direction] < 2 || n[direction] > elvis::native::max_order + 1) {
            return "elements of " + std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " + std::to_string(n[2]) +
                   " nodes; 2 to " + std::to_string(elvis::native::max_order + 1) + " a direction are supported";
        }
        if (content.has_gauss_pressure && n[direction] < 3) {
            return "pressure at Gauss-Legendre points needs 3 or more nodes a direction, and there are " +
                   std::to_string(n[direction]);
        }
    }
    if (content.n_elements == 0 || content.n_elements >= 0xffffffffu) {
        return std::to_string(content.n_elements) + " elements; 1 to 4294967294 are supported";
    }
    return {};
}

} // namespace elvis_nek5000
