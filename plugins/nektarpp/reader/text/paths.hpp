/**
 * @file paths.hpp
 * What the user's paths are: geometry, fields, or sessions without either; files or directories of partitions.
 */
#pragma once

#include "../field/field_file.hpp"
#include "../geometry/geometry_data.hpp"

namespace nektarpp {

struct Input {
    GeometryData geometry;
    std::vector<FieldPaths> steps;
};

/**
 * Reads the geometry and sorts the rest. Directories hold P0000000.xml, .. or P0000000.fld, .. and possibly Info.xml, as
 * Nektar++ writes them in parallel. Throws elvis::api::Error if there is no geometry, or two.
 */
Input read_input(const std::vector<std::string>& paths);

/** Whether a path is one of fields, by its ending or by what a directory holds. */
bool holds_fields(const std::string& path);

/** Whether a file or directory looks like one of Nektar++. */
bool is_nektar(const char* path) noexcept;

} // namespace nektarpp
