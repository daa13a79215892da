/**
 * @file data_set.hpp
 * What the user's files hold together: one mesh, fields, time steps.
 */
#pragma once

#include "boundary.hpp"
#include "point_table.hpp"
#include "snapshot.hpp"

#include <elvis/plugin.hpp>

#include <atomic>
#include <map>

namespace elvis_nek5000 {

class DataSet {
public:
    /** Every path is a list of time steps or any part of one step. Reads headers, and all coordinates once to check them. */
    DataSet(const std::vector<std::string>& paths, const elvis::api::Host& host);

    std::uint32_t dimension() const { return geometry().content().dimension(); }
    std::uint64_t n_elements() const { return geometry().content().n_elements; }
    /** Of the first step; 1 if it is in one piece. */
    std::uint32_t n_parts() const { return m_steps.front()->n_parts(); }
    std::uint32_t part(std::uint64_t element) const { return m_steps.front()->part(element); }
    std::size_t n_steps() const { return m_steps.size(); }
    double time(std::size_t step) const { return m_steps[step]->content().time; }
    /** Those that all time steps have. */
    const std::vector<Block>& fields() const { return m_fields; }
    std::uint32_t n_components(const Block& field) const;
    std::array<std::uint32_t, 3> geometry_order() const;
    /** The highest of all time steps. */
    std::array<std::uint32_t, 3> order(const Block& field) const;
    std::uint32_t mantissa_bits() const;
    /** Below which corners are the same point; 0 if the host's choice is right. */
    double corner_tolerance() const { return m_corner_tolerance; }
    const Boundary& boundary() const { return m_boundary; }

    /** Three coordinates a point. */
    void evaluate_mapping(std::uint64_t element, std::span<const double> xi, std::span<double> positions) const;
    /** All fields at each point. */
    void sample(std::size_t step, std::uint64_t element, std::span<const double> xi, double* values) const;

private:
    const Snapshot& geometry() const { return *m_geometry; }
    void find_geometry();
    void drop_steps_without_fields();
    void check_steps() const;
    void find_fields();
    void check_coordinates();
    void make_tables();
    void begin_step(std::size_t step) const;
    /** That an element of a step with coordinates of its own lies where it does in all others. */
    void check_element(const Snapshot& step, std::uint64_t element) const;

    elvis::api::Host m_host;
    OpenFiles m_files;
    std::vector<std::shared_ptr<const Snapshot>> m_steps;
    /** A step of those, or an earlier one. */
    std::shared_ptr<const Snapshot> m_geometry;
    std::vector<Block> m_fields;
    std::size_t m_n_values = 0;
    double m_largest_coordinate = 0;
    double m_corner_tolerance = 0;
    Boundary m_boundary;
    std::map<NodeSet, PointTables> m_tables;
    /** The step that was sampled last: tables of others are not kept. */
    mutable std::atomic<std::size_t> m_current = 0;
};

} // namespace elvis_nek5000
