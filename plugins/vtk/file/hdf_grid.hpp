/**
 * @file hdf_grid.hpp
 * An unstructured grid in a VTKHDF file: its time steps, and where the parts of each lie.
 */
#pragma once

#include <plugins/hdf5/file.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis_vtk {

/** Where the arrays of a part begin. */
struct HdfPart {
    std::uint64_t n_points = 0;
    std::uint64_t n_cells = 0;
    std::uint64_t n_ids = 0;
    /** First row in Points, Types, Connectivity and Offsets. */
    std::uint64_t first_point = 0;
    std::uint64_t first_cell = 0;
    std::uint64_t first_id = 0;
    std::uint64_t first_offset = 0;
    /** Points and cells of the step's parts before this one. */
    std::uint64_t points_before = 0;
    std::uint64_t cells_before = 0;
};

/** Immutable. The file must outlive it. */
class HdfGrid {
public:
    /** `group`: of type UnstructuredGrid. Reads the lists of parts and steps. */
    HdfGrid(const elvis::hdf5::File& file, std::string group);

    const elvis::hdf5::File& file() const { return m_file; }
    /** The full name of something in the group. */
    std::string name(const std::string& inside) const { return m_group + "/" + inside; }

    /** One if the file has no steps. */
    std::size_t n_steps() const { return m_has_steps ? m_times.size() : 1; }
    /** Empty if the file has no steps. */
    const std::vector<double>& times() const { return m_times; }
    /** TimeValue of the field data. */
    std::optional<double> time_value() const;
    std::vector<HdfPart> parts(std::size_t step) const;
    /** First row of a step in an array of PointData or CellData ("PointData", "CellData"). */
    std::uint64_t first_row(std::size_t step, const std::string& data, const std::string& array) const;
    /** Steps with the same numbers have the same mesh. */
    std::vector<std::uint64_t> mesh_key(std::size_t step) const;

private:
    void read_steps();
    std::vector<std::uint64_t> counts(const std::string& name) const;
    /** A list of the group Steps, with an entry for each. */
    std::vector<std::uint64_t> offsets(const std::string& name) const;

    const elvis::hdf5::File& m_file;
    std::string m_group;
    bool m_has_steps = false;
    std::vector<double> m_times;
    /** Of each part of the file. */
    std::vector<std::uint64_t> m_n_points, m_n_cells, m_n_ids;
    /** Of each step. */
    std::vector<std::uint64_t> m_n_parts, m_first_part, m_first_point, m_first_cell, m_first_id;
};

/** The file's grids: one, or those of a collection. Refuses other types of data with their names. */
std::vector<HdfGrid> hdf_grids(const elvis::hdf5::File& file);

/** 100 for files with the group VTKHDF, of whatever type: those of others are refused with a reason. 0 for other files. */
std::uint32_t probe_hdf(const char* path);

} // namespace elvis_vtk
