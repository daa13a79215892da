/**
 * @file geometry_file.hpp
 * Reads the GEOMETRY of an XML file, plain or compressed.
 */
#pragma once

#include "geometry_data.hpp"

namespace nektarpp {

/**
 * Adds the geometry of a file. Partitions of one mesh are read one after the other: vertices, edges and faces that several of
 * them hold are taken once, composites of the same id grow. Throws elvis::api::Error with the byte and the tag of what is
 * wrong.
 */
void read_geometry(const XmlFile& file, GeometryData& data);

} // namespace nektarpp
