/**
 * @file plugin.cpp
 * Conversion plugin for Gmsh's MSH files.
 */
#include "source.hpp"

namespace {

constexpr elvis_file_format formats[] = {elvis::api::file_format("Gmsh mesh and views", ".msh")};
constexpr elvis_formats formats_table = elvis::api::formats_table(formats);

} // namespace

ELVIS_PLUGIN(.id = "org.elvis.gmsh", .name = "Gmsh reader", .version = "1.0.0", .vendor = "ElVis",
             .description = "Converts Gmsh's MSH files (2.2 and 4.1, text and binary): curved Lagrange elements of any order, "
                            "views on nodes, elements and elements' nodes, interpolation schemes, physical groups.",
             .converter = elvis::api::converter_table<gmsh::Source>(), .formats = &formats_table);
