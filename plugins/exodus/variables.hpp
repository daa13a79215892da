/**
 * @file variables.hpp
 * Fields: variables of nodes and of elements, at the time steps of the file.
 */
#pragma once

#include "mesh.hpp"

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace elvis_exodus {

/** Variables that are one field: one a component, by their numbers in the file, from 0. */
struct Field {
    std::string name;
    bool is_of_elements = false;
    std::vector<std::size_t> variables;
};

/** At one step, for each component of all fields those of all nodes, or of all elements that are read. */
struct StepValues {
    std::vector<std::vector<double>> components;
};

/** One time step is in memory. Any thread may ask for values. */
class Variables {
public:
    Variables(const NetCdf& file, const Mesh& mesh);

    const std::vector<Field>& fields() const { return m_fields; }
    const std::vector<double>& times() const { return m_times; }
    std::uint32_t mantissa_bits() const { return m_mantissa_bits; }
    std::shared_ptr<const StepValues> values(std::size_t step) const;

private:
    void add_fields(const std::vector<std::string>& names, bool is_of_elements);
    std::vector<double> nodal(std::size_t variable, std::size_t step) const;
    std::vector<double> elemental(std::size_t variable, std::size_t step) const;
    /** Where a variable of elements is defined in a block; everywhere if the file has no table. */
    bool has(std::size_t variable, const Block& block) const;

    const NetCdf& m_file;
    const Mesh& m_mesh;
    std::vector<Field> m_fields;
    std::vector<double> m_times;
    std::uint32_t m_mantissa_bits = 53;
    /** By block of the file and variable. */
    std::vector<std::int64_t> m_truth_table;
    std::size_t m_n_element_variables = 0;
    mutable std::mutex m_mutex;
    mutable std::optional<std::size_t> m_step;
    mutable std::shared_ptr<const StepValues> m_values;
};

} // namespace elvis_exodus
