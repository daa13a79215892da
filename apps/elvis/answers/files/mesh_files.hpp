/**
 * @file mesh_files.hpp
 * The files of `elvis extract`. Each appears whole or not at all.
 */
#pragma once

#include <elvis/extract.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace elvis::commands {

/** A field or expression of which a file has the values. */
struct MeshColumn {
    std::string name;
    std::uint32_t n_components = 1;
    /** Where it begins among a vertex's values. */
    std::size_t first = 0;
};

/** Those of fields and expressions, which the volume must know. */
std::vector<MeshColumn> mesh_columns(const data& volume, const std::vector<std::string>& fields);

/** By the ending: .vtp, .ply, .stl; all else is glTF. */
void write_mesh(const extracted& mesh, const std::vector<MeshColumn>& columns, const std::string& path);

/** What was found, for people, each text a line: sizes first; and what may be wrong with it. */
std::vector<std::string> report_of(const elvis_mesh_info& info);
std::vector<std::string> doubts_of(const elvis_mesh_info& info);

/** VTK's PolyData, binary: triangles or lines, normals, elements and values of vertices in double precision. */
void write_mesh_vtp(const extracted& mesh, const std::vector<MeshColumn>& columns, const std::string& path);
/** Binary, in double precision; lines as edges. */
void write_ply(const extracted& mesh, const std::vector<MeshColumn>& columns, const std::string& path);
/** Binary, in single precision: triangles without values. */
void write_stl(const extracted& mesh, const std::string& path);
/**
 * glTF 2.0, binary, in single precision, with +y up as the format wants: what was (x, y, z) is (x, z, -y). Values are
 * attributes whose names begin with an underscore.
 */
void write_glb(const extracted& mesh, const std::vector<MeshColumn>& columns, const std::string& path);

} // namespace elvis::commands
