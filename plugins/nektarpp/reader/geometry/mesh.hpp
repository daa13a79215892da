/**
 * @file mesh.hpp
 * The elements of the domain with their mappings: modified modes from vertices, curved edges and curved faces.
 */
#pragma once

#include "../field/local_numbering.hpp"
#include "../field/mode_set.hpp"
#include "curves.hpp"
#include "geometry_data.hpp"

#include <optional>
#include <string>
#include <vector>

namespace nektarpp {

struct MeshElement {
    Shape shape = Shape::hexahedron;
    std::int64_t id = 0;
    /** Vertices, counted from 0 without gaps. */
    std::array<std::uint32_t, 8> corners{};
    /** Modes in each direction of the mapping; 2 if it is straight. */
    std::uint32_t n_along = 2;
    /** Its curved edges and faces: bends first_bend .. first_bend + n_bends - 1. */
    std::uint32_t n_bends = 0;
    std::uint64_t first_bend = 0;
    /** Boundary group of each local face, or ELVIS_GROUP_NONE. */
    std::array<std::int32_t, 6> groups{};
    /** Ids of the local faces, or edges in two dimensions: those with one id are one. */
    std::array<std::int64_t, 6> sides{};
    std::uint32_t part = 0;
};

/** Immutable after construction: any thread may read. */
class Mesh {
public:
    /** Throws elvis::api::Error that names the element at fault. */
    explicit Mesh(const GeometryData& data);

    int dimension() const { return m_dimension; }
    const std::string& path() const { return m_path; }
    /** In the order of their ids, so that numbers are ids where these are 0 .. n-1. */
    const std::vector<MeshElement>& elements() const { return m_elements; }
    std::size_t n_vertices() const { return m_vertices.size(); }
    /** 1 if the mesh is in one piece. */
    std::uint32_t n_parts() const { return m_n_parts; }
    const std::vector<std::string>& groups() const { return m_groups; }

    /** What is known of an element by its shape and id. */
    struct Found {
        bool exists = false;
        /** Its number; none if it lies outside the domain. */
        std::optional<std::uint64_t> number;
    };
    Found find(Shape shape, std::int64_t id) const;
    /** Elements that `find` finds. */
    std::size_t n_known() const { return m_index.size(); }

    /** Modes of an element's mapping. */
    static ModeSet mapping_modes(const MeshElement& element) { return modified_modes(element.shape, element.n_along); }
    /** Their coefficients: x of all modes, then y, then z. */
    void mapping_coefficients(const MeshElement& element, std::vector<double>& coefficients) const;

private:
    /** A curved edge or face in an element: a bubble, and how its directions lie there. */
    struct Bend {
        std::uint32_t bubble = 0;
        std::uint8_t local = 0;
        bool is_face = false;
        /** The bubble's second direction is the local first. */
        bool is_transposed = false;
        /** The local first and second directions run against the bubble's. */
        std::array<bool, 2> is_reversed{};
    };
    class Builder;

    int m_dimension = 3;
    std::string m_path;
    std::vector<Position> m_vertices;
    std::vector<MeshElement> m_elements;
    std::uint32_t m_n_parts = 1;
    std::vector<Bubble> m_bubbles;
    std::vector<Bend> m_bends;
    std::vector<std::string> m_groups;
    struct Entry {
        Shape shape;
        std::int64_t id;
        /** no_number if outside the domain. */
        std::uint64_t number;
    };
    static constexpr std::uint64_t no_number = ~std::uint64_t{0};
    /** Sorted by shape and id. */
    std::vector<Entry> m_index;
};

} // namespace nektarpp
