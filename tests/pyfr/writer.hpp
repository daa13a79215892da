/**
 * @file writer.hpp
 * Writes small meshes and solutions in PyFR's layouts, by format.md and with nothing of the reader's.
 */
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

/** Coordinates of a point: as many as dimensions. */
using Coordinates = std::vector<double>;

/** Elements of a kind. */
struct WrittenKind {
    std::string name;
    /** Corners and other nodes of the geometry, and where values are, in PyFR's reference coordinates. */
    std::vector<Coordinates> shape_points, solution_points;
    /** Positions: [element][node]. */
    std::vector<std::vector<Coordinates>> elements;
    /** Boundary group of each face, or "": [element][face]. */
    std::vector<std::vector<std::string>> boundary;
    /** Of layout 0, which has one dataset a partition. */
    std::vector<int> partition;
};

struct WrittenMesh {
    std::string uuid = "0123";
    std::vector<WrittenKind> kinds;
};

/** Two quadrilaterals and two triangles, of order 2, on [0, 2] x [0, 2] without a corner, bent by `bent`; values of order 2. */
WrittenMesh plane_mesh();
Coordinates bent(double x, double y);

/** Value at a solution point. */
using Values = std::function<double(const std::string& kind, std::size_t element, std::size_t variable, const Coordinates& x)>;

struct WrittenSolution {
    std::vector<std::string> names = {"rho", "E"};
    Values values;
    std::string prefix = "soln";
    double time = 0;
    bool is_single = false;
    /** In layouts 1 and 2 only these elements of a kind have values. */
    std::map<std::string, std::vector<std::size_t>> only;
    /** In layout 2, members of the records, and how many numbers each has at a solution point for each of their names. */
    struct Group {
        std::string name;
        std::vector<std::string> names;
        std::size_t n_directions = 0;
    };
    std::vector<Group> groups = {{"soln", {"rho", "E"}, 0}};
    /** In layout 0, [solver-elements-KIND] soln-pts. */
    std::map<std::string, std::string> rules = {{"quad", "gauss-legendre"}, {"tri", "williams-shunn"}};
};

void write_mesh(const std::string& path, const WrittenMesh& mesh, int layout);
void write_solution(const std::string& path, const WrittenMesh& mesh, const WrittenSolution& solution, int layout);
