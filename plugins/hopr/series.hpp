/**
 * @file series.hpp
 * States on one mesh, one a time step.
 */
#pragma once

#include "mesh.hpp"
#include "state.hpp"

#include <plugins/hdf5/time_steps.hpp>

namespace elvis_hopr {

/** One variable, or three whose names end with X, Y and Z. */
struct SourceField {
    std::string name;
    std::uint32_t n_components;
    /** One value an element. */
    bool is_constant;
};

/** Any thread may ask. One file is open at a time, but for those that are being read. */
class Series {
public:
    /** Opens each file once: they have the same variables in the same space, and as many elements as the mesh. */
    Series(const std::vector<std::string>& paths, const Mesh& mesh);

    std::size_t n_steps() const { return m_steps.size(); }
    double time(std::size_t step) const { return m_steps.time(step); }
    const std::vector<SourceField>& fields() const { return m_fields; }
    std::uint32_t order() const { return m_order; }
    unsigned mantissa_bits() const { return m_mantissa_bits; }
    /** Whether an element is a finite-volume element at one of the steps. */
    bool is_ever_finite_volume(std::uint64_t element) const { return !m_ever.empty() && m_ever[element]; }
    std::uint64_t n_ever_finite_volume() const;

    /** A file, and which of its elements are finite-volume elements. */
    struct Step {
        State state;
        std::vector<bool> finite_volume;

        bool is_finite_volume(std::uint64_t element) const { return !finite_volume.empty() && finite_volume[element]; }
    };
    std::shared_ptr<const Step> step(std::size_t step) const;

private:
    void add(const State& state, const Mesh& mesh);

    /** What the others are compared with. */
    std::string m_first;
    std::vector<std::string> m_names;
    std::size_t m_n_nodal = 0;
    std::vector<SourceField> m_fields;
    std::uint32_t m_order = 0;
    unsigned m_mantissa_bits = 53;
    std::vector<bool> m_ever;
    mutable elvis::nodal::NodalSpaces m_spaces;
    elvis::hdf5::TimeSteps<Step> m_steps;
};

} // namespace elvis_hopr
