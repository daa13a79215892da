/**
 * @file file.hpp
 * The text format of the plugin, described in README.md.
 */
#pragma once

#include "polynomial.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis::cut_cells {

struct Field {
    std::string name;
    std::uint32_t n_components = 1;
    std::size_t order = 0;
    std::string unit;
};

struct Cell {
    /** In the background grid. */
    std::array<std::size_t, 3> place{};
    /** Of the level set; none in a cell that is not cut. */
    std::vector<double> level;
    /** By field: component after component. */
    std::vector<std::vector<double>> modes;

    bool is_cut() const { return !level.empty(); }
};

struct File {
    std::array<double, 3> lower{}, upper{};
    std::array<std::size_t, 3> n_cells{};
    std::size_t level_order = 0;
    std::vector<Field> fields;
    std::vector<Cell> cells;
};

/** Whether the file begins like one of ours; false if it cannot be read. */
bool has_our_header(const char* path);

/** Throws api::Error with file and line. Whatever it returns is complete and consistent. */
File read_file(const std::string& path);

} // namespace elvis::cut_cells
