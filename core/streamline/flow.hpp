/**
 * @file flow.hpp
 * A vector field as what moves points in reference coordinates.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/expression/expression.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/point_evaluator.hpp>
#include <core/streamline/time_course.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace elvis {

/** What the field does to a point of an element. */
struct FlowSample {
    Vector3 position{};
    /** In the world. */
    Vector3 velocity{};
    /** dxi/dt = J^-1 velocity; in two dimensions of the part in the surface, with 0 as its third. */
    Vector3 slope{};
    /** Jacobian of the mapping, row by row. */
    std::array<double, 9> jacobian{};
    /** How fast what floats there turns about the velocity, in radians per time; 0 unless the flow is asked for it. */
    double spin = 0;
};

/** Throws Error for volumes in which lines cannot be followed. */
void need_evaluation(const RuntimeVolume& volume);

/** Between which times a field that changes is followed, and when points are at their seeds. */
struct FlowTimes {
    std::shared_ptr<const TimeCourse> course;
    double start = 0, first = 0, last = 0;
};

/**
 * A field at one time step, or one that changes in time. The volume, which evaluates on the CPU, must outlive it. Several
 * threads may use it. What it calls `since` is time since the seed, in the direction in which the flow is followed;
 * negative before the seed.
 */
class Flow {
public:
    /** `field`: a vector by name or expression. Throws Error for what is none. */
    Flow(const RuntimeVolume& volume, const std::string& field, std::uint32_t time_step);
    /** Of an expression it is the values at time steps that are interpolated. */
    Flow(const RuntimeVolume& volume, const std::string& field, FlowTimes times);

    /** Opposite to the field, and back in time. */
    Flow reversed() const;
    /**
     * The same, whose samples have their spin: half the vorticity's component along the velocity. Throws Error for a field
     * whose curl is not known.
     */
    Flow with_spin() const;
    bool is_steady() const { return !m_times.course; }
    /** Null if it is steady. */
    const TimeCourse* course() const { return m_times.course.get(); }
    /** When points are at their seeds; 0 if it is steady. */
    double start() const { return m_times.start; }
    /** What is not told from rounding in times; 0 if it is steady. */
    double shortest_time() const { return is_steady() ? 0 : 1e-12 * (m_times.course->last() - m_times.course->first()); }

    FlowSample at(const ReferencePoint& point, double since) const;
    /** The next time step, or the end of what is followed; infinity if it is steady; nothing at the end of time. */
    std::optional<double> next_stop(double since) const;
    /** How far linear interpolation in time may be off there, as a velocity; nothing where that is not known. */
    std::optional<double> interpolation_doubt(const ReferencePoint& point, double since) const;
    const RuntimeVolume& volume() const { return *m_volume; }
    elvis_shape shape_of(std::uint64_t element) const;
    /** Only one thread may use it. */
    bool is_one_at_a_time() const;

private:
    using Components = std::array<std::shared_ptr<const Expression>, 3>;

    /** `components`: of a field as it stands without any. */
    Vector3 at_step(const Components& components, const ReferencePoint& point, std::uint32_t time_step) const;
    Vector3 sum(const Components& components, const ReferencePoint& point, const TimeWeights& weights) const;
    Vector3 value(const Components& components, const ReferencePoint& point, double since) const;

    const RuntimeVolume* m_volume;
    std::uint32_t m_time_step;
    /** Without a course if it is steady. */
    FlowTimes m_times;
    /** The field's text as an expression. */
    std::string m_text;
    /** A field as it stands, or else expressions. */
    std::optional<std::uint32_t> m_field;
    Components m_components;
    /** None unless there is a spin. */
    Components m_curl;
    double m_sign = 1;
};

} // namespace elvis
