/**
 * @file time_steps.hpp
 * Files of a series, one a time step, of which few are open at a time.
 */
#pragma once

#include <algorithm>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace elvis::hdf5 {

/** `Content` is what is known of an open file. Any thread may ask, once all have been added. */
template <class Content> class TimeSteps {
public:
    /** Steps are ordered by time: wildcards of a shell put step 10 in front of step 2. */
    void add(const std::string& path, double time) {
        const auto after = std::ranges::upper_bound(m_steps, time, {}, &Step::time);
        m_steps.insert(after, {time, path});
    }

    std::size_t size() const { return m_steps.size(); }
    double time(std::size_t step) const { return m_steps[step].time; }

    /** What `open(path)` gives, a std::shared_ptr. The last one that was asked for stays open. */
    template <class Open> std::shared_ptr<const Content> get(std::size_t step, Open open) const {
        const std::lock_guard lock(m_mutex);
        if (!m_open || m_open_step != step) {
            m_open = open(m_steps[step].path);
            m_open_step = step;
        }
        return m_open;
    }

private:
    struct Step {
        double time;
        std::string path;
    };
    std::vector<Step> m_steps;
    mutable std::mutex m_mutex;
    mutable std::size_t m_open_step = 0;
    mutable std::shared_ptr<const Content> m_open;
};

} // namespace elvis::hdf5
