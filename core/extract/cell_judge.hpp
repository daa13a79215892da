/**
 * @file cell_judge.hpp
 * Whether cells are fine enough.
 */
#pragma once

#include <core/extract/bends.hpp>
#include <core/extract/element_cells.hpp>
#include <core/extract/nearest.hpp>
#include <core/extract/surface_sampler.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** May be used by several threads at once. */
class CellJudge {
public:
    /** `tolerance`: in world units. */
    CellJudge(const SurfaceSampler& sampler, std::vector<double> contours, double tolerance)
        : m_sampler(sampler), m_contours(std::move(contours)), m_tolerance(tolerance) {}

    /**
     * Of fresh cells: gone are those that the surface surely misses, wanted those to be halved, settled the rest. Cells above
     * `least_depth` are halved as long as they may have a surface. `outer_faces`: bits of the element's faces in which the
     * surface ends. Returns whether samples had to stand for bounds.
     */
    bool judge(ElementCells& cells, const Bend& bend, unsigned least_depth, std::uint32_t outer_faces) const;

private:
    using Corners = std::span<const std::uint32_t>;
    bool is_clear(const ElementCells& cells, Corners corners, double bend) const;
    bool are_faces_clear(const ElementCells& cells, Corners corners, double bend) const;
    void look_for_hidden_parts(ElementCells& cells, const std::vector<std::size_t>& chosen, const Bend& bend,
                               bool& has_sampled) const;
    bool is_unexpected(const ElementCells& cells, const Cell& cell, std::uint32_t point) const;
    struct Piece {
        std::size_t cell;
        CellTriangle triangle;
    };
    void judge_triangles(ElementCells& cells, const std::vector<std::size_t>& chosen, double contour_bend,
                         std::uint32_t outer_faces) const;
    void judge_rims(ElementCells& cells, const std::vector<Piece>& pieces, std::uint32_t outer_faces) const;
    bool are_contours_clear(const ElementCells& cells, const CellTriangle& triangle, double bend) const;
    bool are_contours_fine(const ElementCells& cells, const Cell& cell, const CellTriangle& triangle) const;

    const SurfaceSampler& m_sampler;
    std::vector<double> m_contours;
    double m_tolerance;
};

/** The face that cells of it stand for: its normal, or of flat elements that in the third direction; zero for tetrahedra. */
SurfaceElement surface_element(const ElementCells& cells, const Cell& cell);
Triangle3 flat_triangle(const ElementCells& cells, const CellTriangle& triangle);
/** Where the sides of a triangle meet a contour: side, and the share of the way along it. None or two. */
struct SideCrossing {
    std::size_t side = 0;
    double share = 0;
};
std::vector<SideCrossing> side_crossings(const std::array<double, 3>& values, double isovalue);
/** Where to look for a contour's point on a side: within a face of the element that the side lies in. */
CurveQuery side_query(const ElementCells& cells, const Cell& cell, const CellTriangle& triangle, const SideCrossing& crossing,
                      double isovalue);

} // namespace elvis
