/**
 * @file state.hpp
 * One state of FLEXI, GALAEXI or PICLas: values at the nodes of hexahedra, read by ranges of elements.
 */
#pragma once

#include "finite_volume.hpp"

#include <plugins/hdf5/file.hpp>
#include <plugins/nodal/nodal_space.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace elvis_hopr {

/** Any thread may read. */
class State {
public:
    /** Nodes are taken from `spaces`, if others have had the same. */
    State(elvis::hdf5::File file, elvis::nodal::NodalSpaces& spaces);

    const std::string& path() const { return m_file.path(); }
    double time() const { return m_time; }
    std::uint64_t n_elements() const { return m_n_elements; }
    /** The name of its mesh, as the solver knew it. */
    const std::string& mesh_file() const { return m_mesh_file; }
    const elvis::nodal::NodalSpace& nodes() const { return *m_nodes; }
    unsigned mantissa_bits() const { return m_mantissa_bits; }

    /** Variables with a value at each node, then those with one for each element. */
    const std::vector<std::string>& names() const { return m_names; }
    std::size_t n_nodal() const { return m_n_nodal; }
    std::size_t n_constant() const { return m_names.size() - m_n_nodal; }
    /** Numbers of an element. */
    std::size_t size() const { return m_nodes->size() * m_n_nodal + n_constant(); }

    /** Which elements are finite-volume elements: constant in each of (N+1)^3 cells. Empty if none can be. */
    std::vector<bool> read_finite_volume() const;
    const FiniteVolumeCells& cells() const { return *m_cells; }

    /** For each element [variable][node], then the constants. */
    std::vector<double> read(std::uint64_t first, std::uint64_t count) const;

private:
    /** A dataset, and where its variables are among those of an element. */
    struct Group {
        elvis::hdf5::Dataset data;
        std::size_t first_variable;
        std::size_t n_variables;
        /** Two-dimensional output has one layer of nodes along the third direction. */
        bool is_flat;
    };

    void add_nodal(const std::string& dataset, const std::vector<std::string>& names, elvis::nodal::NodalSpaces& spaces);
    void add_constants();
    void add_name(const std::string& name, const std::string& dataset);
    /** Texts of an attribute; none if it is not there. */
    std::vector<std::string> names_in(const std::string& attribute) const;
    void read_group(const Group& group, std::uint64_t first, std::uint64_t count, std::vector<double>& all) const;

    elvis::hdf5::File m_file;
    std::string m_mesh_file;
    double m_time = 0;
    std::uint64_t m_n_elements = 0;
    unsigned m_mantissa_bits = 53;
    std::shared_ptr<const elvis::nodal::NodalSpace> m_nodes;
    std::unique_ptr<const FiniteVolumeCells> m_cells;
    std::vector<std::string> m_names;
    std::size_t m_n_nodal = 0;
    std::vector<Group> m_groups;
    std::optional<elvis::hdf5::Dataset> m_constants;
    std::optional<std::uint64_t> m_finite_volume_column;
};

bool is_state(const elvis::hdf5::File& file);

} // namespace elvis_hopr
