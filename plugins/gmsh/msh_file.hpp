/**
 * @file msh_file.hpp
 * A whole MSH file by its sections. format.md beside this file describes it.
 */
#pragma once

#include "mesh_sections.hpp"
#include "view_sections.hpp"

#include <map>
#include <string>
#include <vector>

namespace gmsh {

struct MshFile {
    FileMesh mesh;
    std::vector<DataSection> data;
    std::map<std::string, Scheme> schemes;
};

/** Reads and checks a file. Throws elvis::api::Error with the place of what is wrong. */
MshFile read_msh(const std::string& path, const elvis::api::Host& host);

/** 100 if a file begins as MSH files do, a little if it holds the mark of one further down or of an old one, else 0. */
std::uint32_t probe_msh(const char* path);

} // namespace gmsh
