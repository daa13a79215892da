/**
 * @file series.hpp
 * Solutions of one mesh, one a time step.
 */
#pragma once

#include "solution.hpp"

#include <plugins/hdf5/time_steps.hpp>

namespace elvis_pyfr {

/** Any thread may ask. One file is open at a time, but for those that are being read. */
class Series {
public:
    /** Opens each file once: they have the same variables in the same spaces, and belong to the mesh. */
    Series(const std::vector<std::string>& paths, const Mesh& mesh);

    std::size_t n_steps() const { return m_steps.size(); }
    double time(std::size_t step) const { return m_steps.time(step); }
    const std::vector<std::string>& names() const { return m_names; }
    unsigned mantissa_bits() const { return m_mantissa_bits; }
    /** Order of the functions on a kind of elements; nothing if there are none. */
    std::optional<std::uint32_t> order(const Kind& kind) const;

    std::shared_ptr<const Solution> step(std::size_t step) const;

private:
    void add(const Solution& solution, const Mesh& mesh);

    /** What the others are compared with. */
    std::string m_first;
    std::vector<std::string> m_names;
    std::map<const Kind*, std::uint32_t> m_orders;
    unsigned m_mantissa_bits = 53;
    mutable elvis::nodal::NodalSpaces m_spaces;
    elvis::hdf5::TimeSteps<Solution> m_steps;
};

} // namespace elvis_pyfr
