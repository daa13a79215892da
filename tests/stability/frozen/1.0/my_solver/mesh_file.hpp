/**
 * @file mesh_file.hpp
 * The modal format: straight-sided hexahedra, each with the coefficients of a field in products of Legendre polynomials.
 */
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace my_solver {

using Corner = std::array<double, 3>;

struct Hexahedron {
    /** In the order of elvis/element.h: around the bottom, then around the top. */
    std::array<Corner, 8> corners;
    /** That of P_i(xi1) P_j(xi2) P_k(xi3) is number (i (N+1) + j) (N+1) + k. */
    std::vector<double> modes;
};

struct MeshFile {
    std::string field;
    int order = 0;
    std::vector<Hexahedron> hexahedra;

    std::size_t n_modes() const { return static_cast<std::size_t>(order + 1) * (order + 1) * (order + 1); }
};

/** Whether the file begins like one of ours; false if it cannot be read. */
bool is_mesh_file(const char* path);

/** Throws elvis::api::Error that names the file and the hexahedron. */
MeshFile read_mesh_file(const std::string& path);

} // namespace my_solver
