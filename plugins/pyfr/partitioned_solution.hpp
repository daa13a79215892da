/**
 * @file partitioned_solution.hpp
 * Solutions of layout 0: kind by kind and partition by partition, at points that only the configuration names.
 */
#pragma once

#include "solution.hpp"

namespace elvis_pyfr {

class PartitionedSolution : public Solution {
public:
    PartitionedSolution(elvis::hdf5::File file, elvis::nodal::NodalSpaces& spaces);

    void check(const Mesh& mesh) const override;
    std::vector<double> read(const ElementSet& set, std::uint64_t first, std::uint64_t count) const override;

private:
    void add_parts(const Kind& kind, const Ini& config);

    std::map<const Kind*, std::vector<Part>> m_parts;
};

} // namespace elvis_pyfr
