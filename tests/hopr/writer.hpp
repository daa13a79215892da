/**
 * @file writer.hpp
 * Writes small HOPR meshes and states, by format.md and with nothing of the reader's.
 */
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/** A box of unit cubes, one cube after the other, x fastest; order 1. */
struct WrittenMesh {
    /** Lower corners and widths of the elements. */
    struct Box {
        std::array<double, 3> low;
        std::array<double, 3> width;
    };
    std::vector<Box> elements;
    int element_type = 108;
    /** Rows of SideInfo for each element: neighbour and boundary condition. Six, and more where there are mortars. */
    struct Side {
        int neighbour = 0;
        int condition = 0;
    };
    std::vector<std::vector<Side>> sides;
    std::vector<std::string> conditions;
    /** First numbers of BCType. */
    std::vector<int> types;
};

/** Two unit cubes along x, with conditions inflow (x = 0), outflow (x = 2) and a periodic one along y. */
WrittenMesh two_cubes();
/** A cube from x = 0 to 1, and four quarters of a cube from x = 1 to 2 behind a mortar. */
WrittenMesh mortar();

void write_mesh(const std::string& path, const WrittenMesh& mesh);

struct WrittenState {
    int order = 2;
    std::string node_type = "GAUSS";
    /** Nodes of that type. */
    std::vector<double> line;
    std::vector<std::string> names = {"Density", "MomentumX", "MomentumY", "MomentumZ"};
    /** Value of a variable in an element at a reference point. */
    std::function<double(std::size_t variable, std::size_t element, const std::array<double, 3>& xi)> value;
    std::string mesh_file = "somewhere/else/mesh.h5";
    double time = 0;
    /** One layer along the third direction. */
    bool is_flat = false;
    std::vector<std::string> added_names;
    /** [element][variable] */
    std::vector<std::vector<double>> added;
    std::vector<double> cell_widths;
};

void write_state(const std::string& path, const WrittenMesh& mesh, const WrittenState& state);
