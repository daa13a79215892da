#include "cell_kind.hpp"

#include <algorithm>
#include <map>

namespace elvis_vtk {

namespace {

const std::map<int, const char*>& names() {
    static const std::map<int, const char*> table = {
        {0, "VTK_EMPTY_CELL"},
        {1, "VTK_VERTEX"},
        {2, "VTK_POLY_VERTEX"},
        {3, "VTK_LINE"},
        {4, "VTK_POLY_LINE"},
        {5, "VTK_TRIANGLE"},
        {6, "VTK_TRIANGLE_STRIP"},
        {7, "VTK_POLYGON"},
        {8, "VTK_PIXEL"},
        {9, "VTK_QUAD"},
        {10, "VTK_TETRA"},
        {11, "VTK_VOXEL"},
        {12, "VTK_HEXAHEDRON"},
        {13, "VTK_WEDGE"},
        {14, "VTK_PYRAMID"},
        {15, "VTK_PENTAGONAL_PRISM"},
        {16, "VTK_HEXAGONAL_PRISM"},
        {21, "VTK_QUADRATIC_EDGE"},
        {22, "VTK_QUADRATIC_TRIANGLE"},
        {23, "VTK_QUADRATIC_QUAD"},
        {24, "VTK_QUADRATIC_TETRA"},
        {25, "VTK_QUADRATIC_HEXAHEDRON"},
        {26, "VTK_QUADRATIC_WEDGE"},
        {27, "VTK_QUADRATIC_PYRAMID"},
        {28, "VTK_BIQUADRATIC_QUAD"},
        {29, "VTK_TRIQUADRATIC_HEXAHEDRON"},
        {30, "VTK_QUADRATIC_LINEAR_QUAD"},
        {31, "VTK_QUADRATIC_LINEAR_WEDGE"},
        {32, "VTK_BIQUADRATIC_QUADRATIC_WEDGE"},
        {33, "VTK_BIQUADRATIC_QUADRATIC_HEXAHEDRON"},
        {34, "VTK_BIQUADRATIC_TRIANGLE"},
        {35, "VTK_CUBIC_LINE"},
        {36, "VTK_QUADRATIC_POLYGON"},
        {37, "VTK_TRIQUADRATIC_PYRAMID"},
        {41, "VTK_CONVEX_POINT_SET"},
        {42, "VTK_POLYHEDRON"},
        {68, "VTK_LAGRANGE_CURVE"},
        {69, "VTK_LAGRANGE_TRIANGLE"},
        {70, "VTK_LAGRANGE_QUADRILATERAL"},
        {71, "VTK_LAGRANGE_TETRAHEDRON"},
        {72, "VTK_LAGRANGE_HEXAHEDRON"},
        {73, "VTK_LAGRANGE_WEDGE"},
        {74, "VTK_LAGRANGE_PYRAMID"},
        {75, "VTK_BEZIER_CURVE"},
        {76, "VTK_BEZIER_TRIANGLE"},
        {77, "VTK_BEZIER_QUADRILATERAL"},
        {78, "VTK_BEZIER_TETRAHEDRON"},
        {79, "VTK_BEZIER_HEXAHEDRON"},
        {80, "VTK_BEZIER_WEDGE"},
        {81, "VTK_BEZIER_PYRAMID"},
    };
    return table;
}

/** Types whose number of points is fixed. */
struct FixedType {
    Family family;
    elvis_shape shape;
    std::array<std::uint8_t, 3> degree;
};

const std::map<int, FixedType>& fixed_types() {
    static const std::map<int, FixedType> table = {
        {5, {Family::simplex, ELVIS_SHAPE_TRIANGLE, {1, 1, 0}}},
        {9, {Family::tensor, ELVIS_SHAPE_QUADRILATERAL, {1, 1, 0}}},
        {10, {Family::simplex, ELVIS_SHAPE_TETRAHEDRON, {1, 1, 1}}},
        {12, {Family::tensor, ELVIS_SHAPE_HEXAHEDRON, {1, 1, 1}}},
        {13, {Family::wedge, ELVIS_SHAPE_PRISM, {1, 1, 1}}},
        {14, {Family::pyramid_5, ELVIS_SHAPE_PYRAMID, {1, 1, 1}}},
        {22, {Family::simplex, ELVIS_SHAPE_TRIANGLE, {2, 2, 0}}},
        {23, {Family::quadrilateral_8, ELVIS_SHAPE_QUADRILATERAL, {2, 2, 0}}},
        {24, {Family::simplex, ELVIS_SHAPE_TETRAHEDRON, {2, 2, 2}}},
        {25, {Family::hexahedron_20, ELVIS_SHAPE_HEXAHEDRON, {2, 2, 2}}},
        {26, {Family::wedge_15, ELVIS_SHAPE_PRISM, {2, 2, 2}}},
        {27, {Family::pyramid_13, ELVIS_SHAPE_PYRAMID, {2, 2, 2}}},
        {28, {Family::tensor, ELVIS_SHAPE_QUADRILATERAL, {2, 2, 0}}},
        {29, {Family::tensor, ELVIS_SHAPE_HEXAHEDRON, {2, 2, 2}}},
        {30, {Family::tensor, ELVIS_SHAPE_QUADRILATERAL, {2, 1, 0}}},
        {31, {Family::wedge, ELVIS_SHAPE_PRISM, {2, 2, 1}}},
        {32, {Family::wedge, ELVIS_SHAPE_PRISM, {2, 2, 2}}},
        {33, {Family::hexahedron_24, ELVIS_SHAPE_HEXAHEDRON, {2, 2, 2}}},
        {34, {Family::triangle_7, ELVIS_SHAPE_TRIANGLE, {3, 3, 0}}},
    };
    return table;
}

std::size_t size(int degree) { return static_cast<std::size_t>(degree) + 1; }

std::string points(std::size_t n) { return " with " + std::to_string(n) + " points"; }

/** Degree of a cell whose number of points tells it. */
template <class Count> int degree_from(std::size_t n_points, int type, Count&& count) {
    int degree = 1;
    while (count(degree) < n_points && degree <= max_degree) {
        ++degree;
    }
    if (degree > max_degree) {
        throw UnsupportedCell(type_name(type) + points(n_points) + ": degrees up to " + std::to_string(max_degree) +
                              " are read");
    }
    if (count(degree) != n_points) {
        throw UnsupportedCell(type_name(type) + points(n_points) + ", which is the number of no degree");
    }
    return degree;
}

CellKind arbitrary_order_kind(int type, std::size_t n, const std::array<int, 3>& degrees) {
    CellKind kind;
    kind.is_of_any_degree = true;
    kind.is_bezier = type >= 75;
    const int shape = kind.is_bezier ? type - 76 : type - 69;
    if (!kind.is_bezier && ((shape == 0 && n == 7) || (shape == 2 && n == 15) || (shape == 4 && n == 21))) {
        if (shape == 0) {
            return {Family::triangle_7, ELVIS_SHAPE_TRIANGLE, {3, 3, 0}};
        }
        return shape == 2 ? CellKind{Family::tetrahedron_15, ELVIS_SHAPE_TETRAHEDRON, {4, 4, 4}}
                          : CellKind{Family::wedge_21, ELVIS_SHAPE_PRISM, {3, 3, 2}};
    }
    std::array<int, 3> d{};
    if (shape == 0 || shape == 2) {
        const bool is_triangle = shape == 0;
        kind.family = Family::simplex;
        kind.shape = is_triangle ? ELVIS_SHAPE_TRIANGLE : ELVIS_SHAPE_TETRAHEDRON;
        d.fill(degree_from(n, type, [&](int p) {
            return is_triangle ? size(p) * (size(p) + 1) / 2 : size(p) * (size(p) + 1) * (size(p) + 2) / 6;
        }));
    } else {
        kind.family = shape == 4 ? Family::wedge : Family::tensor;
        kind.shape = shape == 1 ? ELVIS_SHAPE_QUADRILATERAL : shape == 3 ? ELVIS_SHAPE_HEXAHEDRON : ELVIS_SHAPE_PRISM;
        const auto count = [&](const std::array<int, 3>& p) {
            return shape == 1   ? size(p[0]) * size(p[1])
                   : shape == 3 ? size(p[0]) * size(p[1]) * size(p[2])
                                : size(p[0]) * (size(p[0]) + 1) / 2 * size(p[2]);
        };
        if (degrees == std::array<int, 3>{}) {
            d.fill(degree_from(n, type, [&](int p) { return count({p, p, p}); }));
        } else {
            d = degrees;
            const int used = shape == 1 ? 2 : 3;
            for (int direction = 0; direction < used; ++direction) {
                if (d[static_cast<std::size_t>(direction)] < 1 || d[static_cast<std::size_t>(direction)] > max_degree) {
                    throw UnsupportedCell(type_name(type) + " of degree " +
                                          std::to_string(d[static_cast<std::size_t>(direction)]) + " (1 to " +
                                          std::to_string(max_degree) + " are read)");
                }
            }
            if (count(d) != n || (shape == 4 && d[0] != d[1])) {
                throw UnsupportedCell(type_name(type) + points(n) + ", which is not the number of its HigherOrderDegrees " +
                                      std::to_string(d[0]) + " " + std::to_string(d[1]) + " " + std::to_string(d[2]));
            }
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        kind.degree[i] = static_cast<std::uint8_t>(i == 2 && dimension(kind) == 2 ? 0 : d[i]);
    }
    return kind;
}

} // namespace

int dimension(const CellKind& kind) {
    return kind.shape == ELVIS_SHAPE_QUADRILATERAL || kind.shape == ELVIS_SHAPE_TRIANGLE ? 2 : 3;
}

std::size_t n_nodes(const CellKind& kind) {
    const std::size_t p = size(kind.degree[0]), q = size(kind.degree[1]), r = size(kind.degree[2]);
    switch (kind.family) {
    case Family::tensor:
        return p * q * r;
    case Family::simplex:
        return dimension(kind) == 2 ? p * (p + 1) / 2 : p * (p + 1) * (p + 2) / 6;
    case Family::wedge:
        return p * (p + 1) / 2 * r;
    case Family::quadrilateral_8:
        return 8;
    case Family::hexahedron_20:
        return 20;
    case Family::hexahedron_24:
        return 24;
    case Family::wedge_15:
    case Family::tetrahedron_15:
        return 15;
    case Family::triangle_7:
        return 7;
    case Family::wedge_21:
        return 21;
    case Family::pyramid_5:
        return 5;
    case Family::pyramid_13:
        return 13;
    }
    return 0;
}

std::array<std::uint32_t, 3> native_order(const CellKind& kind) {
    std::array<std::uint32_t, 3> order{kind.degree[0], kind.degree[1], kind.degree[2]};
    if (kind.shape == ELVIS_SHAPE_PRISM) {
        order = {kind.degree[0], kind.degree[2], kind.degree[0]};
    }
    for (std::uint32_t& one : order) {
        one += kind.is_rational && one > 0 ? 2 : 0;
    }
    return order;
}

std::array<std::uint8_t, 8> corner_nodes(const CellKind& kind) {
    if (kind.shape != ELVIS_SHAPE_PRISM) {
        return {0, 1, 2, 3, 4, 5, 6, 7};
    }
    return kind.is_mirrored ? std::array<std::uint8_t, 8>{0, 2, 5, 3, 1, 4} : std::array<std::uint8_t, 8>{0, 1, 4, 3, 2, 5};
}

std::string type_name(int type) {
    const auto found = names().find(type);
    return found == names().end() ? "cell type " + std::to_string(type)
                                  : std::string(found->second) + " (" + std::to_string(type) + ")";
}

bool is_less_than_surface(int type) {
    constexpr std::array types = {0, 1, 2, 3, 4, 21, 35, 68, 75};
    return std::ranges::find(types, type) != types.end();
}

CellKind kind_of(int type, std::size_t n_points, const std::array<int, 3>& degrees) {
    if (const auto found = fixed_types().find(type); found != fixed_types().end()) {
        const CellKind kind{found->second.family, found->second.shape, found->second.degree};
        if (n_nodes(kind) != n_points) {
            throw UnsupportedCell(type_name(type) + points(n_points) + " instead of " + std::to_string(n_nodes(kind)));
        }
        return kind;
    }
    if (type == 74 || type == 81) {
        throw UnsupportedCell(type_name(type) + ": VTK numbers this type and has no such cell, so that nobody can say where "
                                                "its points lie");
    }
    if ((type >= 69 && type <= 73) || (type >= 76 && type <= 80)) {
        return arbitrary_order_kind(type, n_points, degrees);
    }
    throw UnsupportedCell(type_name(type) + " is not supported");
}

} // namespace elvis_vtk
