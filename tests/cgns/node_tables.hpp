/**
 * @file node_tables.hpp
 * The numbering conventions of the SIDS as tables: without the rules by which the plugin makes them.
 */
#pragma once

#include <array>
#include <string>
#include <vector>

namespace cgns_test {

struct ElementTable {
    /** As in the SIDS. */
    std::string name;
    int dimension;
    int order;
    /** Whether it has all nodes of its order: then it can be any polynomial of that degree, else one of degree 2. */
    bool is_complete;
    std::string shape;
    /** Reference coordinates in order: simplices and heights of pyramids from 0 to 1, others from -1 to 1. */
    std::vector<std::array<double, 3>> nodes;
};

/** All types of triangles to hexahedra, of order 1 to 4. */
std::vector<ElementTable> element_tables();

} // namespace cgns_test
