/**
 * @file dispatch_pace.hpp
 * How much of a kernel goes into one submission.
 */
#pragma once

#include <algorithm>
#include <cstdint>
#include <mutex>

namespace elvis {

/**
 * Chooses the number of work groups of a kernel's next part so that it takes about as long as is wanted, from how long parts
 * took before: no part runs into a driver's time limit, and between parts a task can be stopped. Any thread.
 */
class DispatchPace {
public:
    /** Far below the time limits of drivers (seconds), far above what a submission costs (some 50 microseconds). */
    static constexpr double wanted_milliseconds = 20;
    /** Of parts that are submitted together, between which the device runs empty: what they took is known afterwards only. */
    static constexpr double wanted_collected_milliseconds = 100;

    /** `least`: groups that the device works on at once; fewer take as long. */
    explicit DispatchPace(std::uint64_t least, double wanted = wanted_milliseconds)
        : m_least(std::max<std::uint64_t>(least, 1)), m_wanted(wanted) {}

    /** Groups of the next part, of which there are `n_left`. */
    std::uint64_t next(std::uint64_t n_left) const {
        const std::lock_guard lock(m_mutex);
        return std::min(n_left, std::max(m_least, m_next));
    }

    void took(std::uint64_t n_groups, double milliseconds) {
        const std::lock_guard lock(m_mutex);
        if (!m_has_run) {
            // Drivers may finish compiling in a kernel's first part: its time says nothing.
            m_has_run = true;
            return;
        }
        // The costliest part of a picture is remembered: after much background comes what takes a hundred times as long.
        m_cost = std::max(milliseconds / static_cast<double>(n_groups), m_cost * kept);
        const double wanted = m_cost > 0 ? m_wanted / m_cost : most;
        const std::uint64_t grown = std::max(most_growth * n_groups, m_next);
        m_next = std::min(static_cast<std::uint64_t>(std::min(wanted, most)), grown);
    }

private:
    /** Of the cost, from part to part. */
    static constexpr double kept = 0.98;
    static constexpr std::uint64_t first_groups = 64, most_growth = 4;
    static constexpr double most = 1e9;

    std::uint64_t m_least;
    double m_wanted;
    mutable std::mutex m_mutex;
    std::uint64_t m_next = first_groups;
    /** Milliseconds a group. */
    double m_cost = 0;
    bool m_has_run = false;
};

} // namespace elvis
