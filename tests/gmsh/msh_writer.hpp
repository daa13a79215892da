/**
 * @file msh_writer.hpp
 * Writes meshes and views in every variant of the format.
 */
#pragma once

#include "msh_mesh.hpp"

#include <string>
#include <utility>
#include <vector>

struct Variant {
    bool is_4 = true;
    bool is_binary = false;
    bool is_big_endian = false;
};

struct ViewText {
    std::string section = "NodeData";
    std::string name = "f";
    std::string scheme = {};
    double time = 0;
    int step = 0;
    int n_components = 1;
    /** Tag, and all numbers of it. */
    std::vector<std::pair<std::int64_t, std::vector<double>>> records = {};
};

std::string write_mesh(const MshMesh& mesh, const Variant& variant);
std::string write_view(const ViewText& view, const Variant& variant);
