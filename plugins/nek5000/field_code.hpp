/**
 * @file field_code.hpp
 * What a file holds: the letters of its header.
 */
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace elvis_nek5000 {

enum class Quantity : std::uint8_t { coordinates, velocity, pressure, temperature, scalar };

/** Fields of a file, in the order of their numbers there. */
struct Block {
    Quantity quantity = Quantity::coordinates;
    /** Number of a scalar, from 1. */
    std::uint32_t scalar = 0;

    bool operator==(const Block&) const = default;
    bool is_vector() const { return quantity == Quantity::coordinates || quantity == Quantity::velocity; }
};

/** "velocity", "pressure", "temperature", "S01", ... */
std::string name(const Block& block);

/** Of the letters X U P T Snn, the last with the number of scalars. */
std::optional<std::vector<Block>> parse_code(std::string_view code);
/** Of the letters of old files: X Y Z U P T, and a digit for each scalar, or as above. */
std::optional<std::vector<Block>> parse_old_code(std::string_view code);
/** Of letters at places of their own: X U P T, then one for each scalar (before 2008). */
std::optional<std::vector<Block>> parse_placed_code(std::string_view code);

/** What there is at one time. */
struct Content {
    /** Nodes a direction; the third is 1 in two dimensions. */
    std::array<std::uint32_t, 3> n_nodes{};
    std::uint64_t n_elements = 0;
    double time = 0;
    std::vector<Block> blocks;
    /** Pressure stands at Gauss-Legendre points, two fewer a direction. */
    bool has_gauss_pressure = false;

    std::uint32_t dimension() const { return n_nodes[2] > 1 ? 3 : 2; }
    std::size_t n_points() const { return std::size_t{n_nodes[0]} * n_nodes[1] * n_nodes[2]; }
    std::size_t n_components(const Block& block) const { return block.is_vector() ? dimension() : 1; }
    /** Of all blocks before this one, or of all. */
    std::size_t n_components_before(std::size_t block) const;
    std::size_t n_components() const { return n_components_before(blocks.size()); }
    std::optional<std::size_t> find(const Block& block) const;
    /** Index of an element's node at a corner; bits of `corner` say which end a direction has. */
    std::size_t corner_node(std::size_t corner) const;
    std::optional<std::size_t> coordinates() const { return find({Quantity::coordinates, 0}); }
};

/** Why elements of these nodes cannot be read; empty if they can. */
std::string refusal(const Content& content);

} // namespace elvis_nek5000
