/**
 * @file solutions.hpp
 * Fields: the arrays of the zones' FlowSolution_t.
 */
#pragma once

#include "time_steps.hpp"

#include <mutex>

namespace elvis_cgns {

/** Names of arrays, one a component. */
struct Field {
    std::string name;
    bool is_of_cells = false;
    /** Of the FlowSolution_t in which it lies; empty for that of the time step. */
    std::string solution;
    std::vector<std::string> arrays;
};

/** Values of all fields at a time step: for each component, those of all vertices or of all elements. */
struct StepValues {
    std::vector<std::vector<double>> components;
};

/** One time step is in memory. Any thread may ask for values. */
class Solutions {
public:
    Solutions(Tree& tree, const Base& base, TimeSteps steps, const elvis::api::Host& host);

    const std::vector<Field>& fields() const { return m_fields; }
    const std::vector<double>& times() const { return m_steps.times; }
    std::uint32_t mantissa_bits() const { return m_mantissa_bits; }

    std::shared_ptr<const StepValues> values(std::size_t step) const;

private:
    StepValues read(std::size_t step) const;
    std::vector<double> read_component(std::size_t step, const Field& field, const std::string& array) const;
    std::vector<Node> solutions_of(std::size_t step, std::size_t zone) const;

    Tree& m_tree;
    const Base& m_base;
    TimeSteps m_steps;
    std::vector<Field> m_fields;
    std::uint32_t m_mantissa_bits = 53;

    mutable std::mutex m_mutex;
    mutable std::shared_ptr<const StepValues> m_values;
    mutable std::size_t m_step = 0;
};

} // namespace elvis_cgns
