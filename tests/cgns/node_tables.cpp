#include "node_tables.hpp"

#include <sstream>

namespace cgns_test {

namespace {

/**
 * Steps of 1/order from the first corner along each axis, node by node; in pyramids the first two count from the corner of the
 * section at that height. The order of the SIDS, "Unstructured Grid Element Numbering Conventions", as SU2 and Gmsh have it,
 * with which the tables were compared. Elements with fewer nodes have the first of them.
 */
struct Lattice {
    int dimension;
    int order;
    const char* shape;
    std::vector<std::string> names;
    const char* steps;
};

const std::vector<Lattice>& lattices() {
    static const std::vector<Lattice> all{
        {2, 1, "triangle", {"TRI_3"}, "00 10 01"},
        {2, 2, "triangle", {"TRI_6"}, "00 20 02 10 11 01"},
        {2, 3, "triangle", {"TRI_10", "TRI_9"}, "00 30 03 10 20 21 12 02 01 11"},
        {2, 4, "triangle", {"TRI_15", "TRI_12"}, "00 40 04 10 20 30 31 22 13 03 02 01 11 21 12"},
        {2, 1, "quadrilateral", {"QUAD_4"}, "00 10 11 01"},
        {2, 2, "quadrilateral", {"QUAD_9", "QUAD_8"}, "00 20 22 02 10 21 12 01 11"},
        {2, 3, "quadrilateral", {"QUAD_16", "QUAD_12"}, "00 30 33 03 10 20 31 32 23 13 02 01 11 21 22 12"},
        {2,
         4,
         "quadrilateral",
         {"QUAD_25", "QUAD_P4_16"},
         "00 40 44 04 10 20 30 41 42 43 34 24 14 03 02 01 11 21 31 32 33 23 13 12 22"},
        {3, 1, "tetrahedron", {"TETRA_4"}, "000 100 010 001"},
        {3, 2, "tetrahedron", {"TETRA_10"}, "000 200 020 002 100 110 010 001 101 011"},
        {3,
         3,
         "tetrahedron",
         {"TETRA_20", "TETRA_16"},
         "000 300 030 003 100 200 210 120 020 010 001 002 201 102 021 012 110 101 111 011"},
        {3,
         4,
         "tetrahedron",
         {"TETRA_35", "TETRA_22", "TETRA_34"},
         "000 400 040 004 100 200 300 310 220 130 030 020 010 001 002 003 301 202 103 031 022 013 110 210 120 101 "
         "201 102 211 121 112 021 011 012 111"},
        {3, 1, "pyramid", {"PYRA_5"}, "000 100 110 010 001"},
        {3, 2, "pyramid", {"PYRA_14", "PYRA_13"}, "000 200 220 020 002 100 210 120 010 001 101 111 011 110"},
        {3,
         3,
         "pyramid",
         {"PYRA_30", "PYRA_21", "PYRA_29"},
         "000 300 330 030 003 100 200 310 320 230 130 020 010 001 002 201 102 221 112 021 012 110 210 220 120 101 "
         "211 121 011 111"},
        {3,
         4,
         "pyramid",
         {"PYRA_55", "PYRA_P4_29", "PYRA_50"},
         "000 400 440 040 004 100 200 300 410 420 430 340 240 140 030 020 010 001 002 003 301 202 103 331 222 113 "
         "031 022 013 110 210 310 320 330 230 130 120 220 101 201 102 311 321 212 231 131 122 021 011 012 111 211 "
         "221 121 112"},
        {3, 1, "prism", {"PENTA_6"}, "000 100 010 001 101 011"},
        {3, 2, "prism", {"PENTA_18", "PENTA_15"}, "000 200 020 002 202 022 100 110 010 001 201 021 102 112 012 101 111 011"},
        {3,
         3,
         "prism",
         {"PENTA_40", "PENTA_24", "PENTA_38"},
         "000 300 030 003 303 033 100 200 210 120 020 010 001 002 301 302 031 032 103 203 213 123 023 013 110 101 "
         "201 202 102 211 121 122 212 021 011 012 022 113 111 112"},
        {3,
         4,
         "prism",
         {"PENTA_75", "PENTA_33", "PENTA_66"},
         "000 400 040 004 404 044 100 200 300 310 220 130 030 020 010 001 002 003 401 402 403 041 042 043 104 204 "
         "304 314 224 134 034 024 014 110 210 120 101 201 301 302 303 203 103 102 202 311 221 131 132 133 223 313 "
         "312 222 031 021 011 012 013 023 033 032 022 114 214 124 111 211 121 112 212 122 113 213 123"},
        {3, 1, "hexahedron", {"HEXA_8"}, "000 100 110 010 001 101 111 011"},
        {3,
         2,
         "hexahedron",
         {"HEXA_27", "HEXA_20"},
         "000 200 220 020 002 202 222 022 100 210 120 010 001 201 221 021 102 212 122 012 110 101 211 121 011 112 "
         "111"},
        {3,
         3,
         "hexahedron",
         {"HEXA_64", "HEXA_32", "HEXA_56"},
         "000 300 330 030 003 303 333 033 100 200 310 320 230 130 020 010 001 002 301 302 331 332 031 032 103 203 "
         "313 323 233 133 023 013 110 210 220 120 101 201 202 102 311 321 322 312 231 131 132 232 021 011 012 022 "
         "113 213 223 123 111 211 221 121 112 212 222 122"},
        {3,
         4,
         "hexahedron",
         {"HEXA_125", "HEXA_44", "HEXA_98"},
         "000 400 440 040 004 404 444 044 100 200 300 410 420 430 340 240 140 030 020 010 001 002 003 401 402 403 "
         "441 442 443 041 042 043 104 204 304 414 424 434 344 244 144 034 024 014 110 210 310 320 330 230 130 120 "
         "220 101 201 301 302 303 203 103 102 202 411 421 431 432 433 423 413 412 422 341 241 141 142 143 243 343 "
         "342 242 031 021 011 012 013 023 033 032 022 114 214 314 324 334 234 134 124 224 111 211 311 321 331 231 "
         "131 121 221 112 212 312 322 332 232 132 122 222 113 213 313 323 333 233 133 123 223"},
    };
    return all;
}

std::array<double, 3> point(const Lattice& lattice, const std::string& digits) {
    std::array<double, 3> unit{};
    for (std::size_t axis = 0; axis < digits.size(); ++axis) {
        unit[axis] = static_cast<double>(digits[axis] - '0') / lattice.order;
    }
    const std::string shape = lattice.shape;
    if (shape == "triangle" || shape == "tetrahedron") {
        return unit;
    }
    if (shape == "pyramid") {
        return {2 * unit[0] - (1 - unit[2]), 2 * unit[1] - (1 - unit[2]), unit[2]};
    }
    if (shape == "prism") {
        return {unit[0], unit[1], 2 * unit[2] - 1};
    }
    return {2 * unit[0] - 1, 2 * unit[1] - 1, lattice.dimension == 3 ? 2 * unit[2] - 1 : 0};
}

} // namespace

std::vector<ElementTable> element_tables() {
    std::vector<ElementTable> all;
    for (const Lattice& lattice : lattices()) {
        std::vector<std::array<double, 3>> nodes;
        std::istringstream steps(lattice.steps);
        for (std::string digits; steps >> digits;) {
            nodes.push_back(point(lattice, digits));
        }
        for (const std::string& name : lattice.names) {
            const std::size_t n = std::stoul(name.substr(name.rfind('_') + 1));
            all.push_back({name,
                           lattice.dimension,
                           lattice.order,
                           n == nodes.size(),
                           lattice.shape,
                           {nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(n)}});
        }
    }
    return all;
}

} // namespace cgns_test
