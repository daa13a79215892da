/**
 * @file solution_file.hpp
 * Solutions of layouts 1 and 2: one dataset for each kind, with its solution points.
 */
#pragma once

#include "solution.hpp"

namespace elvis_pyfr {

class SolutionFile : public Solution {
public:
    SolutionFile(elvis::hdf5::File file, int layout, elvis::nodal::NodalSpaces& spaces);

    void check(const Mesh& mesh) const override;
    std::vector<double> read(const ElementSet& set, std::uint64_t first, std::uint64_t count) const override;

private:
    struct Values {
        std::string name;
        elvis::hdf5::Dataset data;
        /** The elements that have values, ascending; all if there is none. */
        std::optional<std::vector<std::int64_t>> elements;
    };

    void add_values(const std::string& name, const Kind& kind);
    /** Layout 2: names from the records' members, which agree in all kinds. */
    void read_names(const Values& values, const Kind& kind);
    std::vector<std::int64_t> read_elements(const std::string& name, std::uint64_t n_rows) const;
    /** [row][variable][point] */
    std::vector<double> read_rows(const Values& values, std::size_t n_points, std::uint64_t first, std::uint64_t count) const;

    int m_layout;
    /** Layout 2: members of the records that hold variables, and how many each. */
    std::vector<std::pair<std::string, std::size_t>> m_groups;
    std::map<const Kind*, Values> m_values;
};

} // namespace elvis_pyfr
