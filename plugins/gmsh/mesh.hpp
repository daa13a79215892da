/**
 * @file mesh.hpp
 * The elements that are converted, with their nodes by position and their boundary groups.
 */
#pragma once

#include "mesh_sections.hpp"
#include "tag_index.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gmsh {

/** Immutable after construction: any thread may read. */
class Mesh {
public:
    /** Fails with the tag of what is wrong. `path` is the file for messages. */
    Mesh(FileMesh&& file, const std::string& path, const elvis::api::Host& host);

    /** 3 if the file holds a three-dimensional element, else 2; elements of lower dimension are not among `n_elements`. */
    int dimension() const { return m_dimension; }
    std::size_t n_nodes() const { return m_positions.size() / 3; }
    std::size_t n_elements() const { return m_types.size(); }
    const ElementType& type(std::size_t element) const { return m_types[element]; }
    /** Nodes in Gmsh's order. */
    std::span<const std::uint32_t> nodes(std::size_t element) const {
        return {m_nodes.data() + m_first_node[element], m_nodes.data() + m_first_node[element + 1]};
    }
    const double* position(std::uint32_t node) const { return m_positions.data() + 3 * static_cast<std::size_t>(node); }

    const std::vector<std::string>& groups() const { return m_groups; }
    /** Group of each native local face, or ELVIS_GROUP_NONE. */
    std::array<std::int32_t, 6> face_groups(std::size_t element) const;

    std::optional<std::uint32_t> find_node(std::uint64_t tag) const { return m_node_index.find(tag); }
    /** Whether the file has an element of this tag, of any dimension. */
    bool has_element(std::uint64_t tag) const { return m_element_index.find(tag).has_value(); }
    /** The converted element of a tag, if there is one. */
    std::optional<std::uint32_t> find_element(std::uint64_t tag) const;

private:
    /** Nodes at the corners of a face, ascending, filled up with the largest number. */
    using FaceKey = std::array<std::uint32_t, 4>;
    static constexpr std::uint32_t nothing = 0xffffffff;

    struct GroupedFace {
        FaceKey key;
        std::int32_t group;
    };

    void keep_element(const ElementType& type, std::span<const std::uint32_t> nodes);
    void drop_copies(const std::string& path);
    void collect_groups(const FileMesh& file, std::span<const std::uint32_t> nodes, const elvis::api::Host& host);
    FaceKey face_key(std::span<const std::uint32_t> nodes) const;

    int m_dimension = 3;
    TagIndex m_node_index;
    TagIndex m_element_index;
    std::vector<double> m_positions;
    std::vector<ElementType> m_types;
    std::vector<std::size_t> m_first_node{0};
    std::vector<std::uint32_t> m_nodes;
    /** By position in the file: converted element, or `nothing`. */
    std::vector<std::uint32_t> m_converted;
    std::vector<std::string> m_groups;
    /** In order of the key. */
    std::vector<GroupedFace> m_faces;
};

} // namespace gmsh
