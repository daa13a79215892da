/**
 * @file mesh.hpp
 * A HOPR mesh of hexahedra: structure in memory, nodes read by ranges.
 */
#pragma once

#include <elvis/plugin.hpp>
#include <plugins/hdf5/file.hpp>
#include <plugins/nodal/nodal_space.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace elvis_hopr {

inline constexpr std::size_t n_corners = 8, n_faces = 6;

/** Corners and boundary groups of an element, in ElVis's order. */
struct ElementTopology {
    std::array<std::int64_t, n_corners> corners{};
    std::array<std::int32_t, n_faces> groups{};
};

/** Any thread may read. About 25 bytes an element are held. */
class Mesh {
public:
    Mesh(elvis::hdf5::File file, const elvis::api::Host& host);

    const std::string& path() const { return m_file.path(); }
    std::uint64_t n_elements() const { return m_first_node.size() - 1; }
    std::uint64_t n_corner_ids() const { return m_n_corner_ids; }
    /** Nodes of the geometry, equidistant. */
    const elvis::nodal::NodalSpace& nodes() const { return *m_nodes; }
    bool is_linear(std::uint64_t element) const { return m_linear[element]; }
    const std::vector<std::string>& groups() const { return m_groups; }

    /** Positions: [element][node][x, y, z]. */
    std::vector<double> read_nodes(std::uint64_t first, std::uint64_t count) const;
    std::vector<ElementTopology> read_topology(std::uint64_t first, std::uint64_t count) const;

private:
    /** A row of SideInfo. */
    enum SideColumn { side_type, side_id, neighbour, neighbour_side, condition, n_side_columns };

    void read_elements();
    void read_conditions();
    void find_linear_elements(const elvis::api::Host& host);
    /** Groups of an element's faces from its rows of SideInfo. */
    std::array<std::int32_t, n_faces> groups_of(std::uint64_t element, std::span<const std::int64_t> rows) const;
    std::int64_t integer_attribute(const std::string& name) const;

    elvis::hdf5::File m_file;
    std::unique_ptr<const elvis::nodal::NodalSpace> m_nodes;
    std::vector<std::size_t> m_corners;
    elvis::hdf5::Dataset m_coordinates;
    elvis::hdf5::Dataset m_sides;
    std::unique_ptr<const elvis::hdf5::Dataset> m_ids;
    std::uint64_t m_n_corner_ids = 0;
    /** Of each element, and the end of the last one. */
    std::vector<std::uint64_t> m_first_node, m_first_side;
    std::vector<bool> m_linear;
    std::vector<std::string> m_groups;
    /** Whether a condition is one between elements, which leaves no boundary. */
    std::vector<bool> m_is_inner;
};

bool is_mesh(const elvis::hdf5::File& file);

} // namespace elvis_hopr
