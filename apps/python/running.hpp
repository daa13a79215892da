/**
 * @file running.hpp
 * Long calls of the library from Python: another thread does the work, so that this one can show progress and hear Ctrl-C.
 */
#pragma once

#include <elvis/elvis.hpp>
#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace elvis::python {

/** What the working thread says, and what it is told. */
class Watch {
public:
    /** For the call; must not outlive this. */
    task watched() {
        return {[this](double fraction, const char* activity) {
                    const std::lock_guard lock(m_mutex);
                    m_fraction = fraction;
                    m_activity = activity;
                    m_has_news = true;
                },
                [this] { return m_is_cancelled.load(std::memory_order_relaxed); }};
    }
    void cancel() { m_is_cancelled = true; }
    void finish() {
        const std::lock_guard lock(m_mutex);
        m_is_done = true;
        m_done.notify_all();
    }
    /** Returns whether the work is done; waits for it that long. */
    bool wait(std::chrono::milliseconds time) {
        std::unique_lock lock(m_mutex);
        return m_done.wait_for(lock, time, [this] { return m_is_done; });
    }
    /** Whether there is something new to show. */
    bool take_news(double& fraction, std::string& activity) {
        const std::lock_guard lock(m_mutex);
        fraction = m_fraction;
        activity = m_activity;
        return std::exchange(m_has_news, false);
    }

private:
    std::mutex m_mutex;
    std::condition_variable m_done;
    double m_fraction = 0;
    std::string m_activity;
    bool m_has_news = false, m_is_done = false;
    std::atomic<bool> m_is_cancelled{false};
};

/** Signals are looked at this often. */
inline constexpr std::chrono::milliseconds signal_interval{20};

/**
 * Calls what(task) on another thread, without the interpreter's lock, and returns when it has ended. Ctrl-C, and an exception
 * of `progress` (a callable of fraction and activity, or None), stop it and are thrown on.
 */
template <class What> void run(const pybind11::object& progress, What what) {
    Watch watch;
    std::exception_ptr thrown;
    std::thread worker([&] {
        try {
            const task watched = watch.watched();
            what(watched);
        } catch (...) {
            thrown = std::current_exception();
        }
        watch.finish();
    });
    bool is_interrupted = false;
    std::exception_ptr interruption;
    while (true) {
        {
            const pybind11::gil_scoped_release unlocked;
            if (watch.wait(signal_interval)) {
                break;
            }
        }
        if (is_interrupted) {
            continue;
        }
        try {
            if (PyErr_CheckSignals() != 0) {
                throw pybind11::error_already_set();
            }
            double fraction = 0;
            std::string activity;
            if (!progress.is_none() && watch.take_news(fraction, activity)) {
                progress(fraction, activity);
            }
        } catch (...) {
            is_interrupted = true;
            interruption = std::current_exception();
            watch.cancel();
        }
    }
    {
        const pybind11::gil_scoped_release unlocked;
        worker.join();
    }
    if (interruption) {
        std::rethrow_exception(interruption);
    }
    if (thrown) {
        std::rethrow_exception(thrown);
    }
}

} // namespace elvis::python
