/**
 * @file session.hpp
 * One person's look at the volume: a scene that messages change, and pictures of it. It outlives the connection.
 */
#pragma once

#include "draw.hpp"

#include <apps/elvis/view/model/model.hpp>

#include <nlohmann/json.hpp>

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace elvis::serve {

/** What goes to the page: JSON, or bytes behind the JSON that tells what they are. */
struct Outgoing {
    bool is_binary = false;
    std::string bytes;
};
/** For any thread; must not wait. */
using Send = std::function<void(Outgoing)>;

/** Frames that were sent and not yet shown. */
inline constexpr int most_unconfirmed = 2;

/** Functions are for any thread, and wait for none that draws. */
class Session {
public:
    Session(std::shared_ptr<const Served> served, std::string id);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    const std::string& id() const { return m_id; }
    /** A page is there, in place of one before: it gets the state, and pictures from now on. */
    void attach(Send send);
    void detach();
    /** A message of the page. What is wrong with it goes back as text. */
    void receive(std::string_view text);
    /** It draws no more, and says no more. */
    void stop();

private:
    using Json = nlohmann::json;
    using Clock = FrameSchedule::Clock;
    /** Runs while the lock is open, with the scene as it was when asked; returns what goes to the page. */
    using Job = std::function<Encoded(const Scene& scene, const task& watch)>;
    struct Task {
        Json answer;
        std::string activity;
        Scene scene;
        Job job;
    };
    struct Unconfirmed {
        std::uint64_t frame = 0;
        Clock::time_point sent;
    };
    /** What one kind of message does; returns what the answer holds, null if that comes later. */
    using Handler = Json (Session::*)(const Json& message);
    static Handler handler_of(const std::string& type);

    // Messages: session_messages.cpp.
    Json resize(const Json& message);
    Json orbit(const Json& message);
    Json pan(const Json& message);
    Json zoom(const Json& message);
    Json roll(const Json& message);
    Json look_from(const Json& message);
    Json project(const Json& message);
    Json place_camera(const Json& message);
    Json release(const Json& message);
    Json set(const Json& message);
    Json merge(const Json& message);
    Json load(const Json& message);
    Json undo(const Json& message);
    Json redo(const Json& message);
    Json add(const Json& message);
    Json remove(const Json& message);
    Json show(const Json& message);
    Json copy(const Json& message);
    Json pick(const Json& message);
    Json range(const Json& message);
    Json undecided(const Json& message);
    Json save_scene(const Json& message);
    Json save_picture(const Json& message);
    Json shown(const Json& message);
    void move_camera(const Camera& camera);
    /** Where the library takes it; throws what it says otherwise. */
    void edit(const std::string& what, const Json& scene);
    /** A step of its own. */
    void change_items(const std::string& what, Scene&& scene);
    void post(const Json& message, std::string activity, Job job);
    view::ItemId item_of(const Json& message) const;
    Json page_json() const;
    Json state() const;
    Json volume() const;

    // Pictures: session.cpp. With the lock held.
    void changed(bool is_moving);
    void send(const Json& message);
    void send(const Json& facts, const std::string& bytes);
    void run(const std::stop_token& stop);
    bool has_work(Clock::time_point now) const;
    /** These open the lock while they work. */
    void do_task(std::unique_lock<std::mutex>& lock);
    void draw(std::unique_lock<std::mutex>& lock, const FrameSchedule::Step& step);
    void send_frame(const FrameSchedule::Step& step, Encoded&& drawn, std::uint64_t revision, const Json& echo);
    void cancel_outdated(Clock::time_point now);
    /** Fewer pixels where the line is slow, more where it is not. */
    void adapt(double milliseconds);

    std::shared_ptr<const Served> m_served;
    std::string m_id;
    mutable std::mutex m_mutex;
    std::condition_variable_any m_changed;
    Send m_send;
    view::Model m_model;
    FrameSchedule m_schedule{20};
    std::deque<Task> m_tasks;
    std::deque<Unconfirmed> m_unconfirmed;
    std::optional<FrameSchedule::Step> m_drawing;
    std::uint64_t m_frame = 0;
    std::optional<std::uint64_t> m_failed_revision;
    Clock::time_point m_last_change{};
    /** The page's mark of its last message, which comes back with the frame. */
    Json m_echo;
    Line m_line;
    double m_confirm_milliseconds = 0;
    bool m_is_refinable = true;
    /** How often exact pictures made way for others. */
    int m_n_yields = 0;
    std::atomic<bool> m_cancelled = false;
    /** After all else, so that it stops first. */
    std::jthread m_thread;
};

} // namespace elvis::serve
