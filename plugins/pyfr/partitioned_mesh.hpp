/**
 * @file partitioned_mesh.hpp
 * Meshes of layout 0: nodes of each element, kind by kind and partition by partition.
 */
#pragma once

#include "mesh.hpp"

#include <map>

namespace elvis_pyfr {

class PartitionedMesh : public Mesh {
public:
    PartitionedMesh(elvis::hdf5::File file, std::string uuid);

    std::uint64_t n_corner_ids() const override { return 0; }
    std::vector<double> read_nodes(const ElementSet& set, std::uint64_t first, std::uint64_t count) const override;
    Topology read_topology(const ElementSet& set, std::uint64_t first, std::uint64_t count) const override;

private:
    void add_parts(const Kind& kind);
    void add_boundary(const std::string& dataset, const std::string& group, std::int64_t partition);

    std::map<const Kind*, std::vector<Part>> m_parts;
    /** A face of the boundary: number of the element in the mesh, PyFR's face. */
    struct BoundaryFace {
        std::uint64_t element;
        std::int64_t face;
        std::int32_t group;
    };
    /** By element. */
    std::vector<BoundaryFace> m_boundary;
};

} // namespace elvis_pyfr
