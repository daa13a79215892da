/**
 * @file mesh_file.hpp
 * Meshes of layouts 1 and 2: nodes of the whole mesh, and elements that refer to them.
 */
#pragma once

#include "mesh.hpp"

#include <map>

namespace elvis_pyfr {

/** Positions of all nodes are held in memory, elements are not. */
class MeshFile : public Mesh {
public:
    MeshFile(elvis::hdf5::File file, std::string uuid);

    std::uint64_t n_corner_ids() const override { return m_nodes.size() / 3; }
    std::vector<double> read_nodes(const ElementSet& set, std::uint64_t first, std::uint64_t count) const override;
    Topology read_topology(const ElementSet& set, std::uint64_t first, std::uint64_t count) const override;

private:
    void read_positions();
    void add_elements(const Kind& kind);
    /** Numbers of nodes: [element][node]. */
    std::vector<std::int64_t> read_numbers(const ElementSet& set, std::uint64_t first, std::uint64_t count) const;

    /** x, y, z of each. */
    std::vector<double> m_nodes;
    std::map<const Kind*, elvis::hdf5::Dataset> m_elements;
    /** Boundary group of each entry of the codec, or -1. */
    std::vector<std::int32_t> m_group_of_code;
};

} // namespace elvis_pyfr
