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
    /**
     * Steps in the order of their times if all have one, else as given. Each is read once: all of it, or what `content` says; a
     * step that was read in part is read again when it is asked for. The mesh must outlive the series.
     */
    FieldSeries(const elvis::api::Host& host, std::vector<FieldPaths> steps, const Mesh& mesh,
                FieldContent content = FieldContent::everything);

    /** Empty if there are no steps. */
    const std::vector<std::string>& fields() const { return m_fields; }
    std::size_t n_steps() const { return m_steps.size(); }
    double time(std::size_t step) const { return m_steps[step].time; }

    /** Target order that holds a field in an element at every step, and whether there is such an order. */
    elvis_source_space space(std::size_t field, std::uint64_t element) const;

    const FieldPaths& paths(std::size_t step) const { return m_steps[step].paths; }

    /**
     * Modes that hold a field in an element at every step; null if no step has data there. Fails if there are none: steps with
     * different bases.
     */
    const ModeSet* modes(std::size_t field, std::uint64_t element) const;

    /** A step's numbers; read again if another step was asked for before. */
    std::shared_ptr<const FieldFile> step(std::size_t step);

private:
    struct Step {
        FieldPaths paths;
        double time = 0;
    };

    void check_fields(const FieldFile& file, const FieldPaths& paths);
    void include_orders(const FieldFile& file);
    void include_modes(const FieldFile& file);

    const Mesh& m_mesh;
    std::vector<Step> m_steps;
    std::vector<std::string> m_fields;
    /** By field and element. */
    std::vector<std::vector<std::array<std::uint8_t, 3>>> m_orders;
    /** By field and element: position among the sets, or one of the two below. */
    std::vector<std::vector<std::uint16_t>> m_modes;
    static constexpr std::uint16_t no_modes = 0xffff, different_bases = 0xfffe;
    std::vector<ModeSet> m_sets;
    std::mutex m_mutex;
    std::size_t m_current_step = 0;
    std::shared_ptr<const FieldFile> m_current;
};

} // namespace nektarpp
