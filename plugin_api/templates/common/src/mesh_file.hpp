/**
 * @file mesh_file.hpp
 * The sample format: hexahedra with a value at each corner. Replace it with the files of your solver.
 */
#pragma once

#include <array>
#include <string>
#include <vector>

namespace @NAME@ {

/** x, y, z and the field's value at a corner. */
using Corner = std::array<double, 4>;

/** Corners in the order of elvis/element.h: around the bottom, then around the top. */
using Hexahedron = std::array<Corner, 8>;

struct MeshFile {
    std::string field;
    std::vector<Hexahedron> hexahedra;
};

/** Whether the file begins like one of ours; false if it cannot be read. */
bool is_mesh_file(const char* path);

/** Throws elvis::api::Error that names file and line. */
MeshFile read_mesh_file(const std::string& path);

} // namespace @NAME@
