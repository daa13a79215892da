/**
 * @file data_set.hpp
 * What the user's files hold together: one mesh, fields, time steps. Collections (.pvd) and parallel files (.pvtu) are
 * followed.
 */
#pragma once

#include "grid.hpp"

namespace elvis_vtk {

struct SourceField {
    std::string name;
    std::uint32_t n_components = 1;
    bool is_of_cells = false;
};

/** Immutable after construction. */
class DataSet {
public:
    /** Reads everything. Every path is a collection or one time step. */
    DataSet(const std::vector<std::string>& paths, const elvis::api::Host& host);

    /** Of all steps; the arrays are empty, see values(). */
    const Grid& mesh() const { return m_mesh; }
    const std::vector<SourceField>& fields() const { return m_fields; }
    const std::vector<double>& times() const { return m_times; }
    /** Of points or cells, as the field says. */
    const std::vector<double>& values(std::size_t step, std::size_t field) const { return m_values[step][field]; }
    std::uint32_t mantissa_bits() const { return m_mantissa_bits; }
    /** Whether cells have points in common. */
    bool has_shared_points() const { return m_has_shared_points; }

private:
    void add_step(Grid&& grid, const std::string& path);

    Grid m_mesh;
    std::vector<SourceField> m_fields;
    std::vector<double> m_times;
    std::vector<std::vector<std::vector<double>>> m_values;
    std::uint32_t m_mantissa_bits = 53;
    bool m_has_shared_points = false;
};

} // namespace elvis_vtk
