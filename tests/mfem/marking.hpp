/**
 * @file marking.hpp
 * What MFEM does to tetrahedra when it reads a mesh for refinement.
 */
#pragma once

#include <string>

/**
 * The text of a mesh whose tetrahedra are turned so that the longest edge comes first, after Tetrahedron::MarkEdge and
 * Mesh::GetEdgeOrdering of MFEM; straight-sided. MFEM numbers edges and faces anew after turning them, so a grid function on
 * the turned mesh is another function than on the mesh of the file.
 */
std::string marked_mesh(const std::string& mesh_text);
