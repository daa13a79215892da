/**
 * @file nurbs_file.hpp
 * The text format of NURBS volumes, described in README.md.
 */
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace elvis::nurbs {

struct Field {
    std::string name;
    std::size_t n_components = 1;
    std::string unit;
};

struct PatchData {
    std::array<int, 3> degree{};
    std::array<std::vector<double>, 3> knots;
    /** x y z w and all components of all fields for each control point, the first direction fastest. */
    std::vector<double> points;

    std::size_t n_points(std::size_t direction) const {
        return knots[direction].size() - static_cast<std::size_t>(degree[direction]) - 1;
    }
};

struct File {
    std::vector<Field> fields;
    std::vector<PatchData> patches;

    /** Numbers of a control point. */
    std::size_t width() const;
};

/** Whether the file begins like one of ours; false if it cannot be read. */
bool has_our_header(const char* path);

/** Throws api::Error with file and line. */
File read_file(const std::string& path);

} // namespace elvis::nurbs
