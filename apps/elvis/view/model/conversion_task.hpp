/**
 * @file conversion_task.hpp
 * A foreign file that becomes a native volume while the window goes on.
 */
#pragma once

#include <core/base/cancel.hpp>

#include <nlohmann/json.hpp>

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace elvis::view {

struct ConversionResult {
    std::string output;
    /** Of elvis_convert. */
    nlohmann::json report;
    /** What plugin and converter warned of. */
    std::string said;
    /** If not empty, there is no output. */
    std::string error;
    bool was_cancelled = false;
};

/** One at a time, in a process of its own: what its plugin does wrong is told and leaves the window as it is. */
class ConversionTask {
public:
    ConversionTask() = default;
    /** Cancels and waits. */
    ~ConversionTask();
    ConversionTask(const ConversionTask&) = delete;
    ConversionTask& operator=(const ConversionTask&) = delete;

    /** Geometry first, then field files. Not while one is running. */
    void start(std::vector<std::string> inputs, std::string output);
    void cancel() { m_control.cancelled = true; }
    bool is_running() const { return m_is_running; }
    /** In [0, 1], or negative if unknown, and what is being done. */
    std::pair<double, std::string> progress() const;
    /** Once, when it has ended. */
    std::optional<ConversionResult> collect();

private:
    TaskControl m_control;
    std::atomic<bool> m_is_running{false};
    mutable std::mutex m_mutex;
    double m_fraction = -1;
    std::string m_activity;
    std::optional<ConversionResult> m_result;
    std::jthread m_thread;
};

} // namespace elvis::view
