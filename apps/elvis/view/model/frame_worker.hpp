/**
 * @file frame_worker.hpp
 * The thread that draws, and answers questions about the volume, while the window goes on.
 */
#pragma once

#include "frame_schedule.hpp"
#include "session.hpp"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace elvis::view {

/** A picture of one of the views, at a stage. */
struct DrawnStep {
    std::size_t view = 0;
    FrameSchedule::Step step;
};

/** A picture that is wanted. */
struct DrawRequest {
    Scene scene;
    DrawnStep of;
    /** What the window knows the scene by. */
    std::uint64_t revision = 0;
};

/** What came of it. */
struct DrawAnswer {
    Picture picture;
    DrawnStep of;
    std::uint64_t revision = 0;
    /** If not empty, there is no picture. */
    std::string error;
};

/** From the wish that a picture be stopped to its end, of the last ones, in milliseconds. */
using CancelTimes = std::deque<double>;
inline constexpr std::size_t most_cancel_times = 200;

/**
 * Jobs are done in their order, before pictures; of pictures that wait only the last one is drawn. The session belongs to the
 * thread: nothing else touches it while it runs.
 */
class FrameWorker {
public:
    explicit FrameWorker(std::unique_ptr<Session> session);
    /** Waits for what is being done. */
    ~FrameWorker();
    FrameWorker(const FrameWorker&) = delete;
    FrameWorker& operator=(const FrameWorker&) = delete;

    /** To be called by the owner when the job is done; may be empty. */
    using Answer = std::function<void()>;
    using Job = std::function<Answer(Session&)>;
    /** A job that throws answers with `on_error`. `activity` says what is being done. */
    void post(std::string activity, Job job, std::function<void(const std::string&)> on_error);
    /** The same, when there is nothing else to do. Jobs that take long should come in pieces. */
    void post_later(std::string activity, Job job, std::function<void(const std::string&)> on_error);

    /** Takes the place of a picture that waits; comes after one that is being drawn. */
    void draw(DrawRequest request);
    /** Stops the picture that is being drawn, and forgets one that waits. Neither gives an answer. */
    void cancel_drawing();
    /** Neither at work nor asked for. */
    bool is_idle() const;
    /** What is being done now; empty if nothing. */
    std::string activity() const;
    /** Of the picture that waits, or else is being drawn and was not cancelled. */
    std::optional<DrawnStep> drawing() const;
    CancelTimes cancel_times() const;

    /** Calls the answers that have come, and returns the last picture among them. */
    std::optional<DrawAnswer> collect();

private:
    struct Task {
        std::string activity;
        Job job;
        std::function<void(const std::string&)> on_error;
    };
    void run(const std::stop_token& stop);
    /** These work while the lock is open. */
    void do_task(std::unique_lock<std::mutex>& lock);
    void draw_wanted(std::unique_lock<std::mutex>& lock);
    DrawAnswer drawn(const DrawRequest& request);

    std::unique_ptr<Session> m_session;
    mutable std::mutex m_mutex;
    std::condition_variable_any m_changed;
    std::deque<Task> m_tasks, m_later_tasks;
    std::optional<DrawRequest> m_wanted;
    std::optional<DrawnStep> m_drawing;
    std::optional<std::chrono::steady_clock::time_point> m_cancelled;
    CancelTimes m_cancel_times;
    std::string m_activity;
    std::vector<Answer> m_answers;
    std::optional<DrawAnswer> m_drawn;
    /** After all else, so that it stops first. */
    std::jthread m_thread;
};

} // namespace elvis::view
