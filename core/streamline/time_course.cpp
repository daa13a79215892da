#include <core/streamline/time_course.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace elvis {

TimeCourse::TimeCourse(std::vector<double> times, TimeInterpolation interpolation, const std::string& name)
    : m_times(std::move(times)), m_interpolation(interpolation) {
    if (m_times.size() < 2) {
        throw Error(name, "has one time step: pathlines need at least two");
    }
    const bool is_ascending = std::ranges::adjacent_find(m_times, std::greater_equal()) == m_times.end();
    if (!is_ascending || !std::ranges::all_of(m_times, [](double time) { return std::isfinite(time); })) {
        throw Error(name, "has times that do not ascend from step to step, between which pathlines cannot be followed");
    }
}

std::size_t TimeCourse::interval(double time) const {
    const auto later = std::ranges::upper_bound(m_times, time);
    const auto index = static_cast<std::size_t>(std::max<std::ptrdiff_t>(later - m_times.begin(), 1) - 1);
    return std::min(index, m_times.size() - 2);
}

TimeWeights TimeCourse::weights(double time, TimeInterpolation interpolation) const {
    const std::size_t here = interval(time);
    TimeWeights sum;
    sum.count = interpolation == TimeInterpolation::linear ? 2 : std::min<std::size_t>(4, m_times.size());
    const std::size_t wished = here - (sum.count > 2 && here > 0 ? 1 : 0);
    const std::size_t first = std::min(wished, m_times.size() - sum.count);
    for (std::size_t i = 0; i < sum.count; ++i) {
        sum.steps[i] = static_cast<std::uint32_t>(first + i);
        sum.weights[i] = 1;
        for (std::size_t j = 0; j < sum.count; ++j) {
            if (j != i) {
                sum.weights[i] *= (time - m_times[first + j]) / (m_times[first + i] - m_times[first + j]);
            }
        }
    }
    return sum;
}

std::optional<TimeWeights> TimeCourse::doubt_at(double time) const {
    if (m_times.size() < 3) {
        return std::nullopt;
    }
    TimeWeights sum = weights(time, TimeInterpolation::cubic);
    const TimeWeights linear = weights(time, TimeInterpolation::linear);
    for (std::size_t i = 0; i < linear.count; ++i) {
        sum.weights[linear.steps[i] - sum.steps[0]] -= linear.weights[i];
    }
    return sum;
}

std::optional<double> TimeCourse::after(double time) const {
    const auto found = std::ranges::upper_bound(m_times, time + rounding());
    return found == m_times.end() ? std::nullopt : std::optional(*found);
}

std::optional<double> TimeCourse::before(double time) const {
    const auto found = std::ranges::lower_bound(m_times, time - rounding());
    return found == m_times.begin() ? std::nullopt : std::optional(*(found - 1));
}

double TimeCourse::middle_about(double time) const {
    const std::size_t here = interval(time);
    return std::midpoint(m_times[here], m_times[here + 1]);
}

} // namespace elvis
