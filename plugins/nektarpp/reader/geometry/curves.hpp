/**
 * @file curves.hpp
 * From points on curved edges and faces to modes of the modified basis.
 */
#pragma once

#include "geometry_data.hpp"

#include <Eigen/LU>

#include <map>
#include <memory>
#include <optional>

namespace nektarpp {

/**
 * Modes of an edge or a face beyond those of its boundary. Edges: i = 2 .. n-1. Quadrilaterals: i, j = 2 .. n-1, j fastest.
 * Triangles: i >= 2, j >= 1, i + j < n, j fastest.
 */
struct Bubble {
    std::uint32_t n_along = 0;
    std::vector<Position> modes;
};

/** Calls visit(i, j) for the modes of a bubble in their order. */
template <class Visit> void for_each_bubble_mode(std::uint32_t n_along, std::size_t n_corners, Visit&& visit) {
    for (std::uint32_t i = 2; i < n_along; ++i) {
        if (n_corners == 2) {
            visit(i, 0u);
        } else if (n_corners == 3) {
            for (std::uint32_t j = 1; i + j < n_along; ++j) {
                visit(i, j);
            }
        } else {
            for (std::uint32_t j = 2; j < n_along; ++j) {
                visit(i, j);
            }
        }
    }
}

/** Interpolates; keeps the factorized matrices. */
class CurveFitter {
public:
    /** The curve's points run from the first end of the edge to the last. */
    Bubble fit_edge(const Curve& curve);
    /** Points in rows along the face's first edge. */
    Bubble fit_quadrilateral(const Curve& curve);
    /** None if the set has no points of that number. */
    std::optional<Bubble> fit_triangle(const Curve& curve);

private:
    using Key = std::pair<PointSet, std::uint32_t>;
    using Lu = Eigen::PartialPivLU<Eigen::MatrixXd>;

    const Lu& line(PointSet set, std::uint32_t n);

    std::map<Key, Lu> m_lines;
    std::map<Key, std::unique_ptr<Lu>> m_triangles;
};

} // namespace nektarpp
