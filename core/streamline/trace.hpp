/**
 * @file trace.hpp
 * Streamlines: curves that are everywhere tangent to a vector field; and pathlines: the ways of points in a field that changes
 * in time.
 *
 * A line is integrated in the reference coordinates of the element that it is in, where field and mapping are smooth. Where it
 * leaves the element, the step is shortened until it ends on the face; the elements that hold this point are asked by Newton's
 * method, and the line goes on in the one that the field leads into. A field that jumps may lead back from both sides of a
 * face: the line ends there, and says so. Steps in time end at time steps, where the interpolation between them is not smooth.
 */
#pragma once

#include <core/base/cancel.hpp>
#include <core/streamline/flow.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace elvis {

enum class TraceDirection : std::uint32_t { both, forward, backward };

enum class TraceEnd : std::uint32_t {
    left_volume, ///< no element goes on
    stagnation,  ///< the field is zero, but for rounding
    length,      ///< as long as was wanted
    steps,       ///< as many steps as were allowed
    jump,        ///< the field leads back from the other side of a face, too
    no_element,  ///< the seed lies in no element: there is no line
    time         ///< of a pathline: the time at which it was to end, or no time step goes on
};

struct TraceOptions {
    TraceDirection direction = TraceDirection::both;
    /** Of a step's error, as a share of the diagonal of the volume's bounds; of the turn's, in radians. */
    double tolerance = 1e-9;
    /** In each direction, in the world; 0: of streamlines ten times the diagonal, of pathlines none. */
    double most_length = 0;
    std::uint32_t most_steps = 100000;
};

struct TracePoint {
    ReferencePoint at;
    Vector3 position{};
    /** Of streamlines from the seed on, negative upstream; of pathlines as time steps have it. */
    double time = 0;
    /** From the seed on; negative upstream. */
    double arc_length = 0;
    /** Of what floats along, about the line's direction, since the seed; radians. 0 of a flow without spin. */
    double turn = 0;
};

/** Points in the order of time, near enough to each other that the direction, and what floats, turn by a few degrees between
 * two. */
struct Streamline {
    std::vector<TracePoint> points;
    /** Why it begins and ends where it does; with one direction only, the other is the seed (length). */
    TraceEnd begin = TraceEnd::length, end = TraceEnd::length;
    /**
     * Of pathlines: how far linear and cubic interpolation in time are apart along the line, as a share of its largest speed;
     * negative where that is not known, as with two time steps only.
     */
    double time_doubt = -1;
};

/** What is asked of pathlines beside TraceOptions. */
struct PathlineOptions {
    TimeInterpolation interpolation = TimeInterpolation::cubic;
    /** When points are at their seeds; by default the first time step's time, or the last one's if they go back in time. */
    std::optional<double> start;
    /** Till when, or since when, lines are followed; by default as far as time steps go. Only of one direction. */
    std::optional<double> end;
};

/** Of the flow of pathlines. Throws Error for volumes without two times that ascend, and for times that they do not hold. */
FlowTimes pathline_times(const RuntimeVolume& volume, TraceDirection direction, const PathlineOptions& options);

/** One line a seed, in the same order. Works on all processors. */
std::vector<Streamline> trace(const Flow& flow, std::span<const Vector3> seeds, const TraceOptions& options,
                              const TaskControl& control);

} // namespace elvis
