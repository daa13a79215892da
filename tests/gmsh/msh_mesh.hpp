/**
 * @file msh_mesh.hpp
 * The tests' own reader of meshes that the gmsh program wrote as text.
 */
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

struct MshElement {
    std::int64_t tag = 0;
    int type = 0;
    /** Physical group in 2.2, model entity in 4.1. */
    int label = 0;
    std::vector<std::int64_t> nodes;
};

struct MshMesh {
    bool is_4 = true;
    std::map<std::int64_t, std::array<double, 3>> nodes;
    std::vector<MshElement> elements;
    /** $PhysicalNames, and in 4.1 $Entities, as they stand in the file. */
    std::string head;

    /** Elements of a dimension, in the file's order: the order of the plugin. */
    std::vector<MshElement> of_dimension(int dimension) const;
};

MshMesh read_mesh(const std::string& path);

/** Dimension, number of nodes, topology as in interpolation schemes, order and kind of an element type. */
struct TypeFacts {
    int dimension;
    int n_nodes;
    int topology;
    int order;
    bool is_serendipity;
};
TypeFacts facts(int type);
