#include "session.hpp"
#include "memory_limit.hpp"

#include <core/base/error.hpp>
#include <core/base/memory.hpp>

#include <algorithm>
#include <chrono>

namespace elvis::serve {

namespace {

/** Of JPEGs: while things move, and at rest until the exact picture comes. */
constexpr int moving_quality = 75, full_quality = 92;
/** From sent to shown. Beyond, fewer pixels go over the line; well below, more. */
constexpr double slow_milliseconds = 250, quick_milliseconds = 80;
constexpr std::uint32_t most_shrink = 8;
constexpr std::chrono::milliseconds short_wait = FrameSchedule::rest / 4;
/** Without work for so long, the thread finds the time to give memory back: of large pictures it is much. */
constexpr int waits_before_tidying = 10;

const char* name_of(FrameStage stage) {
    return stage == FrameStage::moving ? "moving" : stage == FrameStage::full ? "full" : "exact";
}

/** Counts as urgent as long as it lives. */
class Urgent {
public:
    Urgent(const Served& served, bool is_urgent) : m_count(is_urgent ? &served.n_urgent : nullptr) {
        if (m_count != nullptr) {
            ++*m_count;
        }
    }
    ~Urgent() {
        if (m_count != nullptr) {
            --*m_count;
        }
    }
    Urgent(const Urgent&) = delete;
    Urgent& operator=(const Urgent&) = delete;

private:
    std::atomic<int>* m_count;
};

} // namespace

Session::Session(std::shared_ptr<const Served> served, std::string id) : m_served(std::move(served)), m_id(std::move(id)) {
    m_model.open(m_served->first, m_served->facts, {});
    m_thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Session::~Session() { stop(); }

void Session::stop() {
    {
        const std::lock_guard lock(m_mutex);
        m_page = nullptr;
        m_send = {};
        m_companions.clear();
        m_tasks.clear();
        m_later.clear();
        m_cancelled = true;
    }
    m_thread.request_stop();
    m_changed.notify_all();
}

void Session::changed(bool is_moving) {
    const Clock::time_point now = Clock::now();
    const bool goes_on = now - std::exchange(m_last_change, now) < FrameSchedule::rest;
    if (is_moving || goes_on) {
        m_schedule.touch(now);
    } else {
        m_schedule.change();
    }
    m_n_yields = 0;
    cancel_outdated(now);
    cancel_long_task();
    m_changed.notify_all();
}

void Session::cancel_outdated(Clock::time_point now) {
    if (m_drawing && m_schedule.is_outdated(*m_drawing, now)) {
        m_cancelled = true;
    }
}

std::optional<FrameSchedule::Step> Session::next_step(Clock::time_point now) const {
    const bool may_send = m_send && m_unconfirmed.size() < most_unconfirmed && m_failed_revision != m_model.revision();
    return may_send ? m_schedule.next(now) : std::nullopt;
}

bool Session::has_work(Clock::time_point now) const {
    return !m_tasks.empty() || !m_later.empty() || next_step(now) || may_do_long_task(now);
}

void Session::run(const std::stop_token& stop) {
    std::unique_lock lock(m_mutex);
    int n_waits = 0;
    while (!stop.stop_requested()) {
        // Movements end without a message, too.
        if (!m_changed.wait_for(lock, stop, short_wait, [this] { return has_work(Clock::now()); })) {
            if (++n_waits == waits_before_tidying) {
                lock.unlock();
                give_back_free_memory();
                lock.lock();
            }
            continue;
        }
        n_waits = 0;
        m_cancelled = false;
        if (!m_tasks.empty()) {
            do_task(lock, m_tasks);
        } else if (const auto step = next_step(Clock::now())) {
            draw(lock, *step);
        } else if (!m_later.empty()) {
            do_task(lock, m_later);
        } else if (may_do_long_task(Clock::now())) {
            do_long_task(lock);
        }
    }
}

Encoded Session::watched(const std::function<Encoded(const task& watch)>& work, const task& outer) {
    const auto must_stop = [&] { return m_cancelled || (outer.is_cancelled && outer.is_cancelled()); };
    // At the second try, what is kept for later is gone.
    for (const bool is_first : {true, false}) {
        need_memory(*m_served, 0);
        MemoryWatch memory(*m_served);
        try {
            return work({outer.progress, [&] { return must_stop() || memory.is_exceeded(); }});
        } catch (const elvis::error& error) {
            const bool is_cancelled = error.result() == ELVIS_ERROR_CANCELLED && (m_cancelled || !memory.is_exceeded());
            if (is_cancelled || (error.result() != ELVIS_ERROR_CANCELLED && error.result() != ELVIS_ERROR_OUT_OF_MEMORY)) {
                throw;
            }
            m_served->volume.free_memory();
            if (!is_first) {
                throw Error("this takes more memory than the " + limit_text(*m_served) + ": " + error.what());
            }
        }
    }
    return {};
}

void Session::do_task(std::unique_lock<std::mutex>& lock, std::deque<Task>& tasks) {
    Task task = std::move(tasks.front());
    tasks.pop_front();
    send({{"type", "activity"}, {"text", task.activity}});
    lock.unlock();
    Json message = task.answer;
    Encoded result{Json::object(), {}};
    try {
        const Urgent urgent(*m_served, &tasks == &m_tasks);
        result = watched([&](const elvis::task& watch) { return task.job(task.scene, watch); }, {});
        message["type"] = "answer";
        message.update(result.facts);
    } catch (const std::exception& error) {
        message["type"] = "error";
        message["text"] = error.what();
    }
    lock.lock();
    send({{"type", "activity"}, {"text", ""}});
    send_to(task.from, message, result.bytes);
    if (message.contains("picked")) {
        tell_companions({{"type", "picked"}, {"picked", message["picked"]}}, task.from);
    }
}

void Session::draw(std::unique_lock<std::mutex>& lock, const FrameSchedule::Step& step) {
    const Clock::time_point now = Clock::now();
    const bool is_at_rest = now - m_last_change >= FrameSchedule::rest / 2;
    // What full leaves nothing to is drawn once.
    const bool is_exact = step.stage == FrameStage::exact || (step.stage == FrameStage::full && !m_is_refinable && is_at_rest);
    const Scene scene = m_model.scene();
    const std::uint64_t revision = m_model.revision();
    // Of what is drawn, not of what comes meanwhile.
    const Json told = {{"revision", revision}, {"echo", m_echo}, {"overlay", overlay_json()}, {"camera", scene["camera"]}};
    Line line = m_line;
    line.quality = step.stage == FrameStage::moving ? moving_quality : full_quality;
    line.shrink = step.stage == FrameStage::moving ? line.shrink : 1;
    m_drawing = step;
    if (is_exact) {
        send({{"type", "activity"}, {"text", "drawing exactly"}});
    }
    lock.unlock();
    std::optional<Encoded> drawn;
    std::string error;
    std::atomic<bool> has_yielded = false;
    try {
        const Urgent urgent(*m_served, !is_exact);
        const bool may_yield = is_exact && m_n_yields < most_yields;
        const auto yields = [&] {
            if (may_yield && m_served->n_urgent > 0) {
                has_yielded = true;
            }
            return has_yielded.load();
        };
        drawn = watched(
            [&](const task& watch) {
                return is_exact ? draw_exactly(*m_served, scene, watch) : draw_for_screen(*m_served, scene, step, line, watch);
            },
            {{}, yields});
    } catch (const cancelled&) {
        // Something else is wanted.
    } catch (const std::exception& what) {
        error = what.what();
    }
    lock.lock();
    m_drawing.reset();
    if (is_exact) {
        send({{"type", "activity"}, {"text", ""}});
    }
    if (!error.empty()) {
        m_failed_revision = revision;
        send({{"type", "error"}, {"text", error}, {"revision", revision}});
    } else if (drawn) {
        FrameSchedule::Step done = step;
        done.stage = is_exact ? FrameStage::exact : step.stage;
        m_is_refinable = is_exact ? m_is_refinable : drawn->is_refinable;
        // A JPEG is never exact.
        m_schedule.drawn(done, true, drawn->milliseconds);
        send_frame(done, std::move(*drawn), told);
    } else if (has_yielded) {
        ++m_n_yields;
        lock.unlock();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        lock.lock();
    }
}

void Session::send_frame(const FrameSchedule::Step& step, Encoded&& drawn, const Json& told) {
    if (!m_send) {
        m_schedule.change(); // Nobody has seen it.
        return;
    }
    Json facts = std::move(drawn.facts);
    facts.update({{"type", "frame"},
                  {"frame", ++m_frame},
                  {"stage", name_of(step.stage)},
                  {"divisor", step.divisor},
                  {"shrink", step.stage == FrameStage::moving ? m_line.shrink : 1},
                  {"milliseconds", drawn.milliseconds}});
    facts.update(told);
    m_unconfirmed.push_back({m_frame, Clock::now()});
    send(facts, drawn.bytes);
}

Session::Json Session::shown(const Json& message) {
    const auto frame = message.at("frame").get<std::uint64_t>();
    const Clock::time_point now = Clock::now();
    while (!m_unconfirmed.empty() && m_unconfirmed.front().frame <= frame) {
        adapt(std::chrono::duration<double, std::milli>(now - m_unconfirmed.front().sent).count());
        m_unconfirmed.pop_front();
    }
    m_changed.notify_all();
    return Json::object();
}

void Session::adapt(double milliseconds) {
    m_confirm_milliseconds = 0.7 * m_confirm_milliseconds + 0.3 * milliseconds;
    if (m_confirm_milliseconds > slow_milliseconds && m_line.shrink < most_shrink) {
        m_line.shrink *= 2;
        m_confirm_milliseconds = 0.5 * (slow_milliseconds + quick_milliseconds);
    } else if (m_confirm_milliseconds < quick_milliseconds && m_line.shrink > 1) {
        m_line.shrink /= 2;
        m_confirm_milliseconds = 0.5 * (slow_milliseconds + quick_milliseconds);
    }
}

} // namespace elvis::serve
