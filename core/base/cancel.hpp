/**
 * @file cancel.hpp
 * What a long task reports to and asks from whoever started it.
 */
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

namespace elvis {

/** Shared by a task and its owner. Thread-safe as far as the callback is. */
struct TaskControl {
    /** Set by the owner to make the task stop with Cancelled at its next check. */
    std::atomic<bool> cancelled{false};
    /** Another way to ask for the same; may be empty. Called often, from any thread, also from several at once. */
    std::function<bool()> wants_to_stop;
    /** Fraction in [0,1] or negative if unknown, and what is being done. May be empty. */
    std::function<void(double fraction, std::string_view activity)> on_progress;

    bool is_cancelled() const;
    /** Throws Cancelled if asked to stop. */
    void check() const;
    void progress(double fraction, std::string_view activity) const;
};

} // namespace elvis
