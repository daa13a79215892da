/**
 * @file file.hpp
 * The text format of the plugin, described in README.md.
 */
#pragma once

#include "basis.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace elvis::dubiner {

/** Numbers of three vertices, ascending. */
using Triangle = std::array<std::int64_t, 3>;

struct Field {
    std::string name;
    std::uint32_t n_components = 1;
    std::string unit;
};

struct Element {
    std::size_t order = 0;
    std::size_t geometry_order = 1;
    std::array<std::int64_t, 4> vertices{};
    /** Positions of the lattice of geometry_order, xi1 fastest. */
    std::vector<Point> nodes;
};

struct BoundaryFace {
    Triangle vertices{};
    std::size_t group = 0;
};

struct File {
    std::vector<Field> fields;
    std::vector<Element> elements;
    std::vector<std::string> groups;
    std::vector<BoundaryFace> boundary;
    std::vector<double> times;
    /** By time step, field and element: coefficients of orthonormal modes, component after component. */
    std::vector<std::vector<std::vector<std::vector<double>>>> coefficients;
};

/** Whether the file begins like one of ours; false if it cannot be read. */
bool has_our_header(const char* path);

/** Throws api::Error with file and line. Whatever it returns is complete and consistent. */
File read_file(const std::string& path);

} // namespace elvis::dubiner
