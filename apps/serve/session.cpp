#include "session.hpp"

#include <algorithm>
#include <chrono>

namespace elvis::serve {

namespace {

/** Of JPEGs: while things move, and at rest until the exact picture comes. */
constexpr int moving_quality = 75, full_quality = 92;
/** From sent to shown. Beyond, fewer pixels go over the line; well below, more. */
constexpr double slow_milliseconds = 250, quick_milliseconds = 80;
constexpr std::uint32_t most_shrink = 8;
/** An exact picture makes way for other sessions so often, then no more: else it might never be finished. */
constexpr int most_yields = 5;

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
    detach();
    m_thread.request_stop();
    m_changed.notify_all();
}

void Session::attach(Send send) {
    const std::lock_guard lock(m_mutex);
    this->send({{"type", "taken"}});
    m_send = std::move(send);
    m_unconfirmed.clear();
    m_line = {};
    m_confirm_milliseconds = 0;
    m_schedule.change();
    m_failed_revision.reset();
    this->send({{"type", "hello"}, {"session", m_id}, {"volume", volume()}});
    this->send(state());
    m_changed.notify_all();
}

void Session::detach() {
    const std::lock_guard lock(m_mutex);
    m_send = {};
    m_tasks.clear();
    m_cancelled = true;
}

void Session::send(const Json& message) {
    if (m_send) {
        m_send({false, message.dump()});
    }
}

void Session::send(const Json& facts, const std::string& bytes) {
    if (!m_send) {
        return;
    }
    const std::string text = facts.dump();
    // The length of the text, lowest byte first; the text; the bytes.
    Outgoing message{true, {}};
    message.bytes.reserve(4 + text.size() + bytes.size());
    for (unsigned shift = 0; shift < 32; shift += 8) {
        message.bytes += static_cast<char>((text.size() >> shift) & 255u);
    }
    message.bytes += text;
    message.bytes += bytes;
    m_send(std::move(message));
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
    m_changed.notify_all();
}

void Session::cancel_outdated(Clock::time_point now) {
    if (m_drawing && m_schedule.is_outdated(*m_drawing, now)) {
        m_cancelled = true;
    }
}

bool Session::has_work(Clock::time_point now) const {
    if (!m_send) {
        return false;
    }
    return !m_tasks.empty() || (m_unconfirmed.size() < most_unconfirmed && m_failed_revision != m_model.revision() &&
                                m_schedule.next(now).has_value());
}

void Session::run(const std::stop_token& stop) {
    std::unique_lock lock(m_mutex);
    while (!stop.stop_requested()) {
        // Movements end without a message, too.
        if (!m_changed.wait_for(lock, stop, FrameSchedule::rest / 4, [this] { return has_work(Clock::now()); })) {
            continue;
        }
        m_cancelled = false;
        if (!m_tasks.empty()) {
            do_task(lock);
        } else if (const auto step = m_schedule.next(Clock::now())) {
            draw(lock, *step);
        }
    }
}

void Session::do_task(std::unique_lock<std::mutex>& lock) {
    Task task = std::move(m_tasks.front());
    m_tasks.pop_front();
    send({{"type", "activity"}, {"text", task.activity}});
    lock.unlock();
    Json message = std::move(task.answer);
    Encoded result{Json::object(), {}};
    try {
        const Urgent urgent(*m_served, true);
        result = task.job(task.scene, {{}, [this] { return m_cancelled.load(); }});
        message["type"] = "answer";
        message.update(result.facts);
    } catch (const std::exception& error) {
        message["type"] = "error";
        message["text"] = error.what();
    }
    lock.lock();
    send({{"type", "activity"}, {"text", ""}});
    if (result.bytes.empty()) {
        send(message);
    } else {
        send(message, result.bytes);
    }
}

void Session::draw(std::unique_lock<std::mutex>& lock, const FrameSchedule::Step& step) {
    const Clock::time_point now = Clock::now();
    const bool is_at_rest = now - m_last_change >= FrameSchedule::rest / 2;
    // What full leaves nothing to is drawn once.
    const bool is_exact = step.stage == FrameStage::exact || (step.stage == FrameStage::full && !m_is_refinable && is_at_rest);
    const Scene scene = m_model.scene();
    const std::uint64_t revision = m_model.revision();
    const Json echo = m_echo;
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
        const task watch{{}, [&] {
                             if (may_yield && m_served->n_urgent > 0) {
                                 has_yielded = true;
                             }
                             return m_cancelled || has_yielded;
                         }};
        drawn = is_exact ? draw_exactly(*m_served, scene, watch) : draw_for_screen(*m_served, scene, step, line, watch);
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
        send_frame(done, std::move(*drawn), revision, echo);
    } else if (has_yielded) {
        ++m_n_yields;
        lock.unlock();
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        lock.lock();
    }
}

void Session::send_frame(const FrameSchedule::Step& step, Encoded&& drawn, std::uint64_t revision, const Json& echo) {
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
                  {"milliseconds", drawn.milliseconds},
                  {"revision", revision},
                  {"echo", echo}});
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
