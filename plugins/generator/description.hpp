/**
 * @file description.hpp
 * The JSON file that says what to generate. README.md lists its keys.
 */
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace generator {

struct Description {
    std::string mesh = "box";
    std::string shape = "hexahedron";
    /** Lower and upper corner; meshes box and waves. */
    std::array<std::array<double, 3>, 2> box{{{-1, -1, -1}, {1, 1, 1}}};
    std::array<std::uint32_t, 3> elements{4, 4, 4};
    std::uint32_t geometry_order = 1;
    /** Order of the fields; none: the one that contains a polynomial field, 4 for others. */
    std::optional<std::uint32_t> order;
    /** Total degree in x, y, z of the field "polynomial". */
    std::uint32_t degree = 2;
    std::vector<std::string> fields{"sphere"};
    std::uint32_t time_steps = 1;
};

/** Throws elvis::api::Error that names file and key. */
Description read_description(const std::string& path);

/** Whether a file looks like one of this format. Never throws. */
bool is_description(const char* path);

} // namespace generator
