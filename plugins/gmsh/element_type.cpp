#include "element_type.hpp"

#include <array>

namespace gmsh {

namespace {

using enum Topology;

/** A run of consecutive numbers with consecutive orders (GmshDefines.h lists them one by one). */
struct Run {
    int first;
    int last;
    Topology topology;
    int first_order;
    bool is_serendipity;
};

constexpr std::array runs{
    Run{1, 1, line, 1, false},
    Run{2, 2, triangle, 1, false},
    Run{3, 3, quadrilateral, 1, false},
    Run{4, 4, tetrahedron, 1, false},
    Run{5, 5, hexahedron, 1, false},
    Run{6, 6, prism, 1, false},
    Run{7, 7, pyramid, 1, false},
    Run{8, 8, line, 2, false},
    Run{9, 9, triangle, 2, false},
    Run{10, 10, quadrilateral, 2, false},
    Run{11, 11, tetrahedron, 2, false},
    Run{12, 12, hexahedron, 2, false},
    Run{13, 13, prism, 2, false},
    Run{14, 14, pyramid, 2, false},
    Run{15, 15, point, 1, false},
    Run{16, 16, quadrilateral, 2, true},
    Run{17, 17, hexahedron, 2, true},
    Run{18, 18, prism, 2, true},
    Run{19, 19, pyramid, 2, true},
    Run{20, 20, triangle, 3, true},
    Run{21, 21, triangle, 3, false},
    Run{22, 22, triangle, 4, true},
    Run{23, 23, triangle, 4, false},
    Run{24, 24, triangle, 5, true},
    Run{25, 25, triangle, 5, false},
    Run{26, 28, line, 3, false},
    Run{29, 31, tetrahedron, 3, false},
    Run{32, 33, tetrahedron, 4, true},
    Run{36, 38, quadrilateral, 3, false},
    Run{39, 41, quadrilateral, 3, true},
    Run{42, 46, triangle, 6, false},
    Run{47, 51, quadrilateral, 6, false},
    Run{52, 56, triangle, 6, true},
    Run{57, 61, quadrilateral, 6, true},
    Run{62, 66, line, 6, false},
    Run{71, 75, tetrahedron, 6, false},
    Run{79, 83, tetrahedron, 6, true},
    Run{90, 91, prism, 3, false},
    Run{92, 98, hexahedron, 3, false},
    Run{99, 105, hexahedron, 3, true},
    Run{106, 110, prism, 5, false},
    Run{111, 117, prism, 3, true},
    Run{118, 124, pyramid, 3, false},
    Run{125, 131, pyramid, 3, true},
    Run{137, 137, tetrahedron, 3, true},
};

std::size_t n_edges(Topology topology) {
    switch (topology) {
    case point:
        return 0;
    case line:
        return 1;
    case triangle:
        return 3;
    case quadrilateral:
        return 4;
    case tetrahedron:
        return 6;
    case pyramid:
        return 8;
    case prism:
        return 9;
    case hexahedron:
        break;
    }
    return 12;
}

} // namespace

std::optional<ElementType> element_type(int number) {
    for (const Run& run : runs) {
        if (number >= run.first && number <= run.last) {
            return ElementType{run.topology, run.first_order + number - run.first, run.is_serendipity};
        }
    }
    return std::nullopt;
}

int dimension(Topology topology) {
    switch (topology) {
    case point:
        return 0;
    case line:
        return 1;
    case triangle:
    case quadrilateral:
        return 2;
    default:
        return 3;
    }
}

int n_corners(Topology topology) {
    switch (topology) {
    case point:
        return 1;
    case line:
        return 2;
    case triangle:
        return 3;
    case quadrilateral:
    case tetrahedron:
        return 4;
    case pyramid:
        return 5;
    case prism:
        return 6;
    case hexahedron:
        break;
    }
    return 8;
}

std::size_t n_nodes(const ElementType& type) {
    const auto n = static_cast<std::size_t>(type.order);
    if (type.is_serendipity) {
        return static_cast<std::size_t>(n_corners(type.topology)) + n_edges(type.topology) * (n - 1);
    }
    switch (type.topology) {
    case point:
        return 1;
    case line:
        return n + 1;
    case triangle:
        return (n + 1) * (n + 2) / 2;
    case quadrilateral:
        return (n + 1) * (n + 1);
    case tetrahedron:
        return (n + 1) * (n + 2) * (n + 3) / 6;
    case pyramid:
        return (n + 1) * (n + 2) * (2 * n + 3) / 6;
    case prism:
        return (n + 1) * (n + 1) * (n + 2) / 2;
    case hexahedron:
        break;
    }
    return (n + 1) * (n + 1) * (n + 1);
}

std::string name(const ElementType& type) {
    constexpr std::array names{"point", "line", "triangle", "quadrilateral", "tetrahedron", "pyramid", "prism", "hexahedron"};
    return std::to_string(n_nodes(type)) + "-node " + names[static_cast<std::size_t>(type.topology) - 1];
}

elvis::native::Shape shape(Topology topology) {
    using elvis::native::Shape;
    switch (topology) {
    case triangle:
        return Shape::triangle;
    case quadrilateral:
        return Shape::quadrilateral;
    case tetrahedron:
        return Shape::tetrahedron;
    case pyramid:
        return Shape::pyramid;
    case prism:
        return Shape::prism;
    default:
        return Shape::hexahedron;
    }
}

} // namespace gmsh
