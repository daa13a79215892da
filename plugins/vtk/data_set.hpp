/**
 * @file data_set.hpp
 * What the user's files hold together: one mesh, fields, time steps.
 */
#pragma once

#include "grid.hpp"

#include <memory>
#include <mutex>

namespace elvis_vtk {

/** Any thread may ask. The mesh and the values of one time step are held in memory. */
class DataSet {
public:
    /** Reads the mesh, and compares that of every step with it. Every path is a collection, a series or one time step. */
    DataSet(const std::vector<std::string>& paths, const elvis::api::Host& host);

    const Grid& mesh() const { return m_mesh; }
    const std::vector<SourceField>& fields() const { return m_fields; }
    const std::vector<double>& times() const { return m_times; }
    /** Read when it is asked for; the last one stays. */
    std::shared_ptr<const StepValues> values(std::size_t step) const;
    std::uint32_t mantissa_bits() const { return m_mantissa_bits; }
    /** Whether cells have points in common. */
    bool has_shared_points() const { return m_has_shared_points; }

private:
    void set_fields();
    void check_step(const Grid& grid, const std::string& path) const;

    std::vector<TimeStep> m_steps;
    Grid m_mesh;
    std::vector<SourceField> m_fields;
    std::vector<double> m_times;
    std::uint32_t m_mantissa_bits = 53;
    bool m_has_shared_points = false;

    mutable std::mutex m_mutex;
    mutable std::size_t m_held_step = 0;
    mutable std::shared_ptr<const StepValues> m_held;
};

} // namespace elvis_vtk
