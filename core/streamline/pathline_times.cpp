#include <core/streamline/trace.hpp>

#include <core/base/error.hpp>

#include <cstdio>
#include <string>

namespace elvis {

namespace {

/** The time itself, if time steps reach it. */
double checked(const char* name, double time, const TimeCourse& course) {
    if (time >= course.first() && time <= course.last()) {
        return time;
    }
    char text[200];
    std::snprintf(text, sizeof text, "%.17g is not within the times of the volume, %.17g to %.17g", time, course.first(),
                  course.last());
    throw Error(name, text);
}

} // namespace

FlowTimes pathline_times(const RuntimeVolume& volume, TraceDirection direction, const PathlineOptions& options) {
    auto course = std::make_shared<const TimeCourse>(volume.times(), options.interpolation, volume.path());
    const bool is_backward = direction == TraceDirection::backward;
    FlowTimes times{course, is_backward ? course->last() : course->first(), course->first(), course->last()};
    if (options.start) {
        times.start = checked("start time", *options.start, *course);
    }
    if (options.end) {
        if (direction == TraceDirection::both) {
            throw Error("end time", "is of one direction: forward or backward");
        }
        (is_backward ? times.first : times.last) = checked("end time", *options.end, *course);
        if (!(times.first < times.last) || times.start < times.first || times.start > times.last) {
            throw Error("end time", is_backward ? "is not before the start time" : "is not after the start time");
        }
    }
    return times;
}

} // namespace elvis
