/**
 * @file mesh.hpp
 * The cells of all zones of a base as elements, zone after zone.
 */
#pragma once

#include "boundary.hpp"
#include "element/element_type.hpp"

#include <unordered_map>

namespace elvis_cgns {

/** Cells between vertices, kept in memory. Any thread may ask. */
class Mesh {
public:
    /** The name of the nodes with the coordinates. Ends with an error where the base cannot be read. */
    Mesh(Tree& tree, const Base& base, const std::string& coordinates, const elvis::api::Host& host);

    std::uint64_t n_elements() const { return m_types.size(); }
    std::uint64_t n_vertices() const { return m_points.size() / 3; }
    std::uint32_t mantissa_bits() const { return m_mantissa_bits; }
    /** Whether elements have vertices in common, so that these tell which elements are neighbours. */
    bool has_shared_vertices() const { return m_has_shared_vertices; }

    const ElementType& type(std::uint64_t element) const { return element_type(m_types[element]); }
    /** As the SIDS number types. */
    std::int64_t type_number(std::uint64_t element) const { return m_types[element]; }
    /** Vertices of all zones, counted from 0. */
    std::span<const std::uint32_t> nodes(std::uint64_t element) const {
        return std::span(m_connectivity).subspan(m_first[element], m_first[element + 1] - m_first[element]);
    }
    /** Three numbers. */
    const double* point(std::uint32_t vertex) const { return &m_points[3 * std::size_t{vertex}]; }

    /** Of which zone of the base an element is. */
    std::size_t zone(std::uint64_t element) const;

    const std::vector<std::string>& groups() const { return m_groups; }
    /** Of a local face of elvis/element.h; ELVIS_GROUP_NONE where there is none. */
    std::int32_t face_group(std::uint64_t element, std::size_t face) const;

private:
    void read_points(Tree& tree, const Base& base, const Zone& zone, const std::string& coordinates);
    /** Those of the last zone, whose vertices begin at `first_vertex`. */
    void add_groups(const std::vector<BoundaryGroup>& groups, std::uint32_t first_vertex);
    void append_element(std::int64_t type, std::span<const std::uint32_t> nodes);

    std::vector<double> m_points;
    std::vector<std::uint8_t> m_types;
    /** In the connectivity, of each element and of the end. */
    std::vector<std::uint64_t> m_first{0};
    std::vector<std::uint32_t> m_connectivity;
    /** Of each zone, the first element. */
    std::vector<std::uint64_t> m_zones;
    std::uint32_t m_mantissa_bits = 53;
    bool m_has_shared_vertices = false;
    std::vector<std::string> m_groups;
    /** By 8 * element + face. */
    std::unordered_map<std::uint64_t, std::int32_t> m_face_groups;
};

} // namespace elvis_cgns
