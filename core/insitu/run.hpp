/**
 * @file run.hpp
 * A running solver, and what is made of it.
 */
#pragma once

#include "communicator_team.hpp"
#include "insitu_volume.hpp"
#include "plan.hpp"
#include "samples.hpp"

#include <core/api/handles.hpp>
#include <core/parts/draw_in_parts.hpp>
#include <core/render/renderer.hpp>
#include <core/session/still_picture.hpp>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace elvis::library {

class InsituRun {
public:
    /** Collective. */
    InsituRun(std::shared_ptr<Context> context, const elvis_communicator* communicator, const elvis_arrays& arrays,
              const std::string& plan, std::string folder);
    /** Collective: a table, and what its functions get. `communicator` may be null: of one rank. */
    InsituRun(std::shared_ptr<Context> context, const elvis_communicator* communicator, const elvis_runtime& table,
              elvis_volume* volume, const std::uint8_t* is_own, const std::string& plan, std::string folder);
    InsituRun(const InsituRun&) = delete;
    InsituRun& operator=(const InsituRun&) = delete;

    void set_values(std::uint32_t field, std::uint32_t element_class, const double* values);
    /** Collective. */
    void step(std::uint64_t step, double time);
    elvis_insitu_report report() const;

private:
    struct Output {
        PlannedOutput planned;
        /** Of such outputs. */
        std::unique_ptr<Samples> samples;
        std::optional<TableFile> numbers;
    };

    void open_plan(const std::string& plan);
    void open_table(const elvis_runtime& table, elvis_volume* volume, const std::uint8_t* is_own, const std::string& plan);
    void add(PlannedOutput planned);
    void check_order(std::uint64_t step, double time) const;
    void make(std::uint64_t step, double time);
    bool is_wanted(const Output& output, std::uint64_t step, double time);
    void write(Output& output, std::uint64_t step, double time);
    void draw(const Output& output, const PlannedPicture& planned, std::uint64_t step);
    void write_numbers(const Output& output, const PlannedNumbers& planned, std::uint64_t step, double time);
    VolumeInParts& parts(Precision precision);
    Renderer& renderer(Precision precision);
    StillPicture picture_of(const Scene& scene, bool with_buffers);
    Prober* prober();
    std::string path(const std::string& name) const;
    void say_cost(std::uint64_t step);

    std::shared_ptr<Context> m_context;
    TaskControl m_control;
    CommunicatorTeam m_team;
    std::string m_folder;
    std::unique_ptr<InsituVolume> m_volume;
    std::optional<Reductions> m_reductions;
    std::optional<Prober> m_prober;
    std::map<Precision, std::unique_ptr<VolumeInParts>> m_parts;
    /** Of a volume without parts. */
    std::map<Precision, std::unique_ptr<Renderer>> m_renderers;
    /** Planned outputs stay where they are: samples refer to them. */
    std::vector<std::unique_ptr<Output>> m_outputs;
    std::optional<std::uint64_t> m_last_step;
    std::optional<double> m_last_time;
    std::chrono::steady_clock::time_point m_opened;
    elvis_insitu_report m_report{};
};

} // namespace elvis::library
