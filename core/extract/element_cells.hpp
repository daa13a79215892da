/**
 * @file element_cells.hpp
 * One element, divided into simplices.
 */
#pragma once

#include <core/extract/surface_sampler.hpp>

#include <elvis/element.h>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

namespace elvis {

/** Two numbers, the smaller one in front. */
inline std::uint64_t pair_key(std::uint32_t a, std::uint32_t b) {
    return a < b ? (std::uint64_t{a} << 32) | b : (std::uint64_t{b} << 32) | a;
}

/** A corner of cells, or a place where the surface meets an edge of cells. */
struct CellPoint {
    static constexpr std::uint32_t no_id = 0xffffffffu;
    Vector3 xi{}, position{};
    Sloped level, contour;
    /** Length of the level's gradient in the world. */
    double steepness = 0;
    /** Of corners: the same for the elements that share the place. */
    std::uint32_t id = no_id;
    /** Of places on edges: the corners at the ends. */
    std::array<std::uint32_t, 2> ends{no_id, no_id};
};

/** A tetrahedron, or, where the surface is made of faces, a triangle. */
struct Cell {
    enum class State : std::uint8_t {
        fresh,   ///< not looked at
        settled, ///< as fine as it has to be
        wanted,  ///< to be halved
        gone     ///< halved, or without surface
    };
    std::array<std::uint32_t, 4> corners{};
    std::uint8_t n_corners = 4, depth = 0;
    /** Of triangles: the face of the element that they are in; -1: the element is flat, and they are of it. */
    std::int8_t local_face = -1;
    State state = State::fresh;
    /** As small as the tolerance, and not decided whether a part of the surface hides in it. */
    bool is_undecided = false;

    std::size_t n_edges() const { return n_corners == 4 ? 6 : 3; }
    /** Corners of an edge. */
    std::array<std::uint32_t, 2> edge(std::size_t index) const;
};

/** Numbers of points. */
using CellTriangle = std::array<std::uint32_t, 3>;

class ElementCells {
public:
    ElementCells(std::uint64_t element, elvis_shape shape, std::vector<int> faces)
        : m_element(element), m_shape(shape), m_faces(std::move(faces)) {}

    std::uint64_t element() const { return m_element; }
    elvis_shape shape() const { return m_shape; }
    std::vector<CellPoint>& points() { return m_points; }
    const std::vector<CellPoint>& points() const { return m_points; }
    std::vector<Cell>& cells() { return m_cells; }
    const std::vector<Cell>& cells() const { return m_cells; }
    /** Determinant of the Jacobian in the middle is negative. */
    bool is_inverted() const { return m_is_inverted; }

    /** Points of the shape; cells follow when these have ids. */
    void place_corners(const SurfaceSampler& sampler);
    void make_cells();

    /** Halves wanted cells at their longest edges, which `is_longer` finds of two pairs of ids. */
    struct Halved {
        /** Points that may not have ids yet. */
        std::vector<std::uint32_t> points;
        /** Pairs of ids. */
        std::vector<std::uint64_t> edges;
    };
    Halved halve_wanted(const SurfaceSampler& sampler, const std::function<bool(std::uint64_t, std::uint64_t)>& is_longer);
    /** The point in the middle of two, which evaluate_new() may still have to find. */
    std::uint32_t middle(std::uint32_t a, std::uint32_t b);
    void evaluate_new(const SurfaceSampler& sampler);
    /** Forgets cells that are gone. */
    void sweep();

    /** Finds where the surface meets the edges of a cell, which are not known yet. */
    void meet_edges(const SurfaceSampler& sampler, std::span<const std::size_t> cells);
    /** The surface in a cell, whose edges have been met; orientation is that in reference coordinates. */
    std::vector<CellTriangle> triangles(const Cell& cell) const;
    bool has_surface(const Cell& cell) const;

private:
    std::uint32_t met(std::uint32_t a, std::uint32_t b) const;

    std::uint64_t m_element;
    elvis_shape m_shape;
    /** Empty: the element itself. */
    std::vector<int> m_faces;
    bool m_is_inverted = false;
    std::vector<CellPoint> m_points;
    std::size_t m_n_evaluated = 0;
    std::vector<Cell> m_cells;
    /** By pairs of points. */
    std::unordered_map<std::uint64_t, std::uint32_t> m_middles, m_met;
};

/** A corner's side of the surface: what is zero is with what is larger. */
inline bool is_above(const CellPoint& point) { return point.level.value >= 0; }

} // namespace elvis
