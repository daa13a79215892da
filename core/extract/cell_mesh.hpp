/**
 * @file cell_mesh.hpp
 * Elements divided into simplices that fit together: what is halved in one element is halved in all that share the edge.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/base/cancel.hpp>
#include <core/extract/cell_judge.hpp>
#include <core/extract/element_cells.hpp>
#include <core/extract/point_weld.hpp>

#include <cstdint>
#include <functional>
#include <unordered_set>
#include <vector>

namespace elvis {

/** What is known of an element before it is divided. */
struct MeshElement {
    std::uint64_t element = 0;
    elvis_shape shape = ELVIS_SHAPE_HEXAHEDRON;
    /** Its faces that are the surface; empty: itself. */
    std::vector<int> faces;
    Bend bend;
    unsigned least_depth = 0;
    /** Bits of faces without neighbour; of edges, in two dimensions. */
    std::uint32_t outer_faces = 0;
};

class CellMesh {
public:
    /** Ascending elements. `tolerance`: in world units. Nothing is halved that would make for more cells than `most_cells`. */
    CellMesh(const SurfaceSampler& sampler, const CellJudge& judge, std::vector<MeshElement> elements, double tolerance,
             std::uint64_t most_cells, const TaskControl& control);

    /** Halves cells until all are fine enough. Throws Error when there are too many. */
    void refine();
    std::vector<ElementCells>& elements() { return m_cells; }
    const std::vector<ElementCells>& elements() const { return m_cells; }
    bool has_wanted() const;
    std::uint64_t n_cells() const;
    std::uint64_t n_sampled_elements() const;

    /** Calls work(index of an element) on all cores. */
    void for_each_element(const char* activity, const std::function<void(std::size_t)>& work);

private:
    void weld(CellPoint& point, double distance);
    void judge_fresh();
    void halve_wanted();
    void mark_neighbours(const std::unordered_set<std::uint64_t>& halved);
    bool is_longer(std::uint64_t edge, std::uint64_t other) const;

    const SurfaceSampler& m_sampler;
    const CellJudge& m_judge;
    const TaskControl& m_control;
    std::vector<MeshElement> m_elements;
    std::vector<ElementCells> m_cells;
    /** Of each element: how near points are one, and whether samples had to do. */
    std::vector<double> m_distances;
    std::vector<std::uint8_t> m_is_sampled;
    double m_tolerance;
    std::uint64_t m_most_cells;
    PointWeld m_weld;
    /** What levels of a place may differ by from element to element without a jump. */
    double m_level_rounding = 0;
    std::unordered_set<std::uint64_t> m_halved;
    Background m_background;
};

} // namespace elvis
