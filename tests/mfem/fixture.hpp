/**
 * @file fixture.hpp
 * What the tests of the MFEM plugin share.
 */
#pragma once

#include <core/convert/convert.hpp>
#include <core/oracle/element/volume.hpp>
#include <core/plugin_host/source_volume.hpp>
#include <tests/support/files.hpp>

#include <array>
#include <filesystem>
#include <string>
#include <vector>

using elvis::test::read_file;
using elvis::test::TemporaryFolder;

/** Opens a mesh and solutions with the plugin. */
elvis::SourceVolume open_mfem(const std::vector<std::string>& paths);

/** A file below the folder of MFEM's data sets; a failure if it is missing. */
std::string mfem_data(const std::string& name);

/** The header of a file of a solution. */
std::string space_text(const std::string& collection, int n_components = 1, int ordering = 0);

/** The message with which files are refused. */
std::string failure(const std::vector<std::string>& paths);

elvis_source_element get_element(const elvis::SourceVolume& source, std::uint64_t number);

/** `text` with the first `what` in it replaced; a failure if there is none. */
std::string replaced(std::string text, const std::string& what, const std::string& by);

/** ElVis's reference point of a point in MFEM's shapes (2 triangle, 3 square, 4 tetrahedron, 5 hexahedron, 6 prism, 7 pyramid).
 */
std::array<double, 3> from_mfem(int geometry, const std::array<double, 3>& x);

/** A line of a file of reference values. */
struct ReferencePoint {
    std::size_t element = 0;
    int geometry = 0;
    elvis::oracle::Vector xi, x;
    std::vector<double> value;
};

std::vector<ReferencePoint> read_reference(const std::string& path, std::size_t n_components);

/** A conversion, read back. */
struct Converted {
    elvis::ConvertReport report;
    elvis::oracle::Volume volume;
    /** Place in the volume of each element's number. */
    std::vector<std::size_t> place;
};

Converted convert_mfem(const elvis::SourceVolume& source, std::size_t field = 0);
