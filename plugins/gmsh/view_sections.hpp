/**
 * @file view_sections.hpp
 * Reads the sections that hold fields, as they stand in the file: the same in MSH 2.2 and 4.1.
 */
#pragma once

#include "cursor.hpp"
#include "scheme.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gmsh {

enum class DataKind { node, element, element_node };

std::string section_name(DataKind kind);

/** One $NodeData, $ElementData or $ElementNodeData. */
struct DataSection {
    DataKind kind = DataKind::node;
    /** For messages. */
    std::string path;
    std::string view;
    /** Name of the interpolation scheme; empty: none. */
    std::string scheme;
    double time = 0;
    std::int32_t step = 0;
    std::int32_t partition = 0;
    std::uint32_t n_components = 1;
    /** Of nodes or elements. */
    std::vector<std::uint64_t> tags;
    /** Numbers of tag `i` are values[first[i]] .. values[first[i + 1] - 1]. */
    std::vector<std::size_t> first{0};
    std::vector<double> values;
};

DataSection read_data(Cursor& cursor, DataKind kind);

/** $InterpolationScheme, which is text in binary files too: its name and content. */
std::pair<std::string, Scheme> read_scheme(Cursor& cursor);

} // namespace gmsh
