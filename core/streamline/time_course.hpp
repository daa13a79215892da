/**
 * @file time_course.hpp
 * How a field goes on between the time steps at which it is known.
 *
 * Its values at a fixed point of an element are interpolated by the polynomial of degree 3 through the four steps nearest to
 * the time (Lagrange; of lower degree where there are fewer), or of degree 1 through the two beside it. With steps a time h
 * apart, the errors are at most 3/128 h^4 |d4v/dt4| (1/24 h^4 |d4v/dt4| in the first and the last interval) and 1/8 h^2
 * |d2v/dt2|. A field whose course in time is of such a degree is followed exactly.
 */
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

enum class TimeInterpolation : std::uint32_t { cubic, linear };

/** A sum over time steps. */
struct TimeWeights {
    std::size_t count = 0;
    std::array<std::uint32_t, 4> steps{};
    std::array<double, 4> weights{};
};

class TimeCourse {
public:
    /** `times`: of the steps. `name` stands for the volume in the Error about less than two or such as do not ascend. */
    TimeCourse(std::vector<double> times, TimeInterpolation interpolation, const std::string& name);

    double first() const { return m_times.front(); }
    double last() const { return m_times.back(); }
    /** Those that give the field at a time between the first and the last. */
    TimeWeights at(double time) const { return weights(time, m_interpolation); }
    /** The same of degree 3 less those of degree 1: how far linear interpolation is off, about. None of two steps only. */
    std::optional<TimeWeights> doubt_at(double time) const;
    /** The first step's time that is later, or that is earlier, than this one by more than rounding. */
    std::optional<double> after(double time) const;
    std::optional<double> before(double time) const;
    /** The middle of the two steps that a time is between. */
    double middle_about(double time) const;

private:
    /** The last step that is not later, but never the very last. */
    std::size_t interval(double time) const;
    TimeWeights weights(double time, TimeInterpolation interpolation) const;
    double rounding() const { return 1e-12 * (last() - first()); }

    std::vector<double> m_times;
    TimeInterpolation m_interpolation;
};

} // namespace elvis
