/**
 * @file write_task.hpp
 * A file of numbers that is being written, as the thread that writes it and the window see it.
 */
#pragma once

#include <elvis/elvis.hpp>

#include <atomic>
#include <mutex>
#include <string>
#include <utility>

namespace elvis::view {

/** One at a time. Every function may be called from any thread. */
class WriteTask {
public:
    void begin();
    void end() { m_is_running = false; }
    void cancel() { m_is_cancelled = true; }
    bool is_running() const { return m_is_running; }
    /** In [0, 1], or negative if unknown, and what is being done. */
    std::pair<double, std::string> progress() const;
    /** For the one who writes; must not outlive this. */
    task watch();

private:
    std::atomic<bool> m_is_running{false}, m_is_cancelled{false};
    mutable std::mutex m_mutex;
    double m_fraction = -1;
    std::string m_activity;
};

} // namespace elvis::view
