/**
 * @file field_series.hpp
 * The time steps of a data set. All are read and checked at the start; one at a time stays in memory.
 */
#pragma once

#include "field_file.hpp"

#include <elvis/plugin.hpp>

#include <memory>
#include <mutex>

namespace nektarpp {

/** `step` may be called by several threads at once. */
class FieldSeries {
public:
    /** Steps in the order of their times if all have one, else as given. The mesh must outlive the series. */
    FieldSeries(const elvis::api::Host& host, std::vector<FieldPaths> steps, const Mesh& mesh);

    /** Empty if there are no steps. */
    const std::vector<std::string>& fields() const { return m_fields; }
    std::size_t n_steps() const { return m_steps.size(); }
    double time(std::size_t step) const { return m_steps[step].time; }

    /** Target order that holds a field in an element at every step, and whether there is such an order. */
    elvis_source_space space(std::size_t field, std::uint64_t element) const;

    /** A step's numbers; read again if another step was asked for before. */
    std::shared_ptr<const FieldFile> step(std::size_t step);

private:
    struct Step {
        FieldPaths paths;
        double time = 0;
    };

    void check_fields(const FieldFile& file, const FieldPaths& paths);
    void include_orders(const FieldFile& file);

    const Mesh& m_mesh;
    std::vector<Step> m_steps;
    std::vector<std::string> m_fields;
    /** By field and element. */
    std::vector<std::vector<std::array<std::uint8_t, 3>>> m_orders;
    std::mutex m_mutex;
    std::size_t m_current_step = 0;
    std::shared_ptr<const FieldFile> m_current;
};

} // namespace nektarpp
