/**
 * @file long_task.hpp
 * What a command does around a task that takes its time: a way to stop it and a sign that it goes on.
 */
#pragma once

#include <core/base/cancel.hpp>

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <string_view>
#include <thread>

namespace elvis::commands {

inline std::atomic<int> n_interrupts{0};
static_assert(std::atomic<int>::is_always_lock_free);

/** What the second interrupt does. */
enum class SecondInterrupt {
    ends_program, ///< at once: a plugin or a driver may not return
    is_counted,   ///< whoever runs the task looks at n_interrupts
    is_ignored    ///< nor are there words about the first: another program asks, and knows how to insist
};
inline std::atomic<SecondInterrupt> second_interrupt{SecondInterrupt::ends_program};

/** Ctrl-C and a polite kill ask the task to stop instead of ending the process, as long as this lives. */
class InterruptGuard {
public:
    explicit InterruptGuard(TaskControl& control, SecondInterrupt second = SecondInterrupt::ends_program)
        : m_previous_interrupt(std::signal(SIGINT, on_signal)), m_previous_terminate(std::signal(SIGTERM, on_signal)),
          m_watcher([&control](const std::stop_token& stop) {
              while (!stop.stop_requested()) {
                  control.cancelled = n_interrupts > 0;
                  std::this_thread::sleep_for(std::chrono::milliseconds(20));
              }
          }) {
        second_interrupt = second;
    }
    ~InterruptGuard() {
        std::signal(SIGINT, m_previous_interrupt);
        std::signal(SIGTERM, m_previous_terminate);
    }
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

private:
    static void on_signal(int signal) {
        const bool is_first = n_interrupts++ == 0;
        if (!is_first && second_interrupt == SecondInterrupt::ends_program) {
            std::signal(signal, SIG_DFL);
            ::raise(signal);
        }
        if (!is_first || second_interrupt == SecondInterrupt::is_ignored) {
            return;
        }
        constexpr std::string_view text = "\nelvis: stopping; once more to stop at once\n";
        if ([[maybe_unused]] const ssize_t n = ::write(STDERR_FILENO, text.data(), text.size()); n < 0) {
            return; // Nobody is left to be told.
        }
    }

    void (*m_previous_interrupt)(int);
    void (*m_previous_terminate)(int);
    std::jthread m_watcher;
};

/** One line on a terminal that shows how far the task has come. */
class ProgressBar {
public:
    explicit ProgressBar(TaskControl& control) {
        if (::isatty(STDERR_FILENO) == 0) {
            return;
        }
        control.on_progress = [this](double fraction, std::string_view activity) {
            const std::lock_guard lock(m_mutex);
            const auto now = std::chrono::steady_clock::now();
            if (now - m_last < std::chrono::milliseconds(100)) {
                return;
            }
            m_last = now;
            m_is_drawn = true;
            const int done = fraction < 0 ? 0 : static_cast<int>(40 * fraction);
            std::fprintf(stderr, "\r[%.*s%*s] %-24.*s", done, "========================================", 40 - done, "",
                         static_cast<int>(activity.size()), activity.data());
        };
    }
    ~ProgressBar() {
        if (m_is_drawn) {
            std::fprintf(stderr, "\r\033[K");
        }
    }
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

private:
    std::mutex m_mutex;
    std::chrono::steady_clock::time_point m_last{};
    bool m_is_drawn = false;
};

} // namespace elvis::commands
