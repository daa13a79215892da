#include "frame_worker.hpp"
#include "model.hpp"

#include <core/base/error.hpp>
#include <core/base/memory.hpp>
#include <core/base/milliseconds.hpp>

#include <utility>

namespace elvis::view {

namespace {

/** Without work for so long, the thread finds the time to give memory back. */
constexpr std::chrono::milliseconds rest_before_tidying{200};

} // namespace

FrameWorker::FrameWorker(std::unique_ptr<Session> session)
    : m_session(std::move(session)), m_thread([this](const std::stop_token& stop) { run(stop); }) {}

FrameWorker::~FrameWorker() {
    m_thread.request_stop();
    m_session->control().cancelled = true;
    m_changed.notify_all();
}

void FrameWorker::post(std::string activity, Job job, std::function<void(const std::string&)> on_error) {
    const std::lock_guard lock(m_mutex);
    m_tasks.push_back({std::move(activity), std::move(job), std::move(on_error)});
    m_changed.notify_all();
}

void FrameWorker::post_later(std::string activity, Job job, std::function<void(const std::string&)> on_error) {
    const std::lock_guard lock(m_mutex);
    m_later_tasks.push_back({std::move(activity), std::move(job), std::move(on_error)});
    m_changed.notify_all();
}

void FrameWorker::draw(DrawRequest request) {
    const std::lock_guard lock(m_mutex);
    m_wanted = std::move(request);
    m_changed.notify_all();
}

void FrameWorker::cancel_drawing() {
    const std::lock_guard lock(m_mutex);
    m_wanted.reset();
    if (m_drawing) {
        m_session->control().cancelled = true;
        m_drawing.reset();
        m_cancelled = std::chrono::steady_clock::now();
    }
}

bool FrameWorker::is_idle() const {
    const std::lock_guard lock(m_mutex);
    return m_tasks.empty() && m_later_tasks.empty() && !m_wanted && m_activity.empty();
}

std::string FrameWorker::activity() const {
    const std::lock_guard lock(m_mutex);
    return m_activity;
}

std::optional<DrawnStep> FrameWorker::drawing() const {
    const std::lock_guard lock(m_mutex);
    return m_wanted ? std::optional(m_wanted->of) : m_drawing;
}

CancelTimes FrameWorker::cancel_times() const {
    const std::lock_guard lock(m_mutex);
    return m_cancel_times;
}

std::optional<DrawAnswer> FrameWorker::collect() {
    std::vector<Answer> answers;
    std::optional<DrawAnswer> drawn;
    {
        const std::lock_guard lock(m_mutex);
        answers.swap(m_answers);
        drawn.swap(m_drawn);
    }
    for (const Answer& answer : answers) {
        answer();
    }
    return drawn;
}

DrawAnswer FrameWorker::drawn(const DrawRequest& request) {
    DrawAnswer answer;
    answer.of = request.of;
    answer.revision = request.revision;
    try {
        answer.picture = m_session->draw(request.scene, request.of.step);
        answer.picture.camera = camera_of(part_of(request.scene, "camera"));
    } catch (const cancelled&) {
        throw;
    } catch (const std::exception& error) {
        answer.error = error.what();
    }
    return answer;
}

void FrameWorker::do_task(std::unique_lock<std::mutex>& lock) {
    std::deque<Task>& tasks = m_tasks.empty() ? m_later_tasks : m_tasks;
    const Task task = std::move(tasks.front());
    tasks.pop_front();
    m_activity = task.activity;
    lock.unlock();
    Answer answer;
    try {
        answer = task.job(*m_session);
    } catch (const std::exception& error) {
        answer = [on_error = task.on_error, what = std::string(error.what())] { on_error(what); };
    }
    lock.lock();
    m_activity.clear();
    if (answer) {
        m_answers.push_back(std::move(answer));
    }
}

void FrameWorker::draw_wanted(std::unique_lock<std::mutex>& lock) {
    const DrawRequest request = std::move(*m_wanted);
    m_wanted.reset();
    m_drawing = request.of;
    m_activity = "drawing";
    lock.unlock();
    std::optional<DrawAnswer> answer;
    try {
        answer = drawn(request);
    } catch (const cancelled&) {
        // Another picture is wanted.
    }
    lock.lock();
    m_activity.clear();
    m_drawing.reset();
    if (m_cancelled) {
        m_cancel_times.push_back(milliseconds_since(*std::exchange(m_cancelled, {})));
        if (m_cancel_times.size() > most_cancel_times) {
            m_cancel_times.pop_front();
        }
    } else if (answer) {
        m_drawn = std::move(answer);
    }
}

void FrameWorker::run(const std::stop_token& stop) {
    std::unique_lock lock(m_mutex);
    // Drivers that compile for a CPU leave hundreds of mebibytes free in the heap after a change of scene.
    bool has_free_memory = true;
    const auto is_asked = [this] { return !m_tasks.empty() || m_wanted || !m_later_tasks.empty(); };
    while (true) {
        if (has_free_memory && !m_changed.wait_for(lock, stop, rest_before_tidying, is_asked) && !stop.stop_requested()) {
            has_free_memory = false;
            lock.unlock();
            give_back_free_memory();
            lock.lock();
        }
        m_changed.wait(lock, stop, is_asked);
        if (stop.stop_requested()) {
            return;
        }
        has_free_memory = true;
        m_session->control().cancelled = false;
        if (!m_tasks.empty() || !m_wanted) {
            do_task(lock);
        } else {
            draw_wanted(lock);
        }
    }
}

} // namespace elvis::view
