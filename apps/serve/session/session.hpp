/**
 * @file session.hpp
 * One person's look at the volume: a scene that messages change, and pictures of it. It outlives the connection.
 */
#pragma once

#include <apps/elvis/view/model/model.hpp>
#include <apps/serve/answers/draw.hpp>
#include <apps/serve/answers/film.hpp>

#include <nlohmann/json.hpp>

#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
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
/** Somebody who speaks to a session: a mark of the connection. */
using Member = const void*;

/** Frames that were sent and not yet shown. */
inline constexpr int most_unconfirmed = 2;
/** What takes long makes way for other sessions so often, then no more: else it might never be finished. */
inline constexpr int most_yields = 5;

/** Functions are for any thread, and wait for none that draws. */
class Session {
public:
    Session(std::shared_ptr<const Served> served, std::string id);
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    const std::string& id() const { return m_id; }
    /** A page is there, in place of one before: it gets the state, and pictures from now on. */
    void attach(Member page, Send send);
    /** A program is there, beside the page: it gets the state, and is told of the camera and of what is picked. */
    void attach_companion(Member companion, Send send);
    void detach(Member member);
    /** A message of one of them; of others it is dropped. What is wrong with it goes back as text. */
    void receive(Member from, std::string_view text);
    /** Forgets all steps of undo but a few, and says why. */
    void spare_memory();
    /** It draws no more, and says no more. */
    void stop();

private:
    using Json = nlohmann::json;
    using Clock = FrameSchedule::Clock;
    /** Runs while the lock is open, with the scene as it was when asked; returns what goes to the page. */
    using Job = std::function<Encoded(const Scene& scene, const task& watch)>;
    struct Task {
        Member from = nullptr;
        Json answer;
        std::string activity;
        Scene scene;
        Job job;
    };
    /** A task that makes way for pictures, and is begun again when they are drawn. */
    struct LongTask {
        Task task;
        bool is_running = false, is_stopped = false;
        /** How often it made way for other sessions. */
        int n_yields = 0;
        Clock::time_point not_before{};
    };
    struct BegunFilm {
        Member from = nullptr;
        std::shared_ptr<Film> film;
    };
    struct Unconfirmed {
        std::uint64_t frame = 0;
        Clock::time_point sent;
    };
    /** What one kind of message does; returns what the answer holds, null if that comes later. */
    using Handler = Json (Session::*)(const Json& message);
    static Handler handler_of(const std::string& type);

    // Messages: session_messages.cpp, session_scene.cpp, session_overlay.cpp, session_answers.cpp, session_long.cpp.
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
    Json check(const Json& message);
    Json merge(const Json& message);
    Json load(const Json& message);
    Json undo(const Json& message);
    Json redo(const Json& message);
    Json add(const Json& message);
    Json remove(const Json& message);
    Json show(const Json& message);
    Json copy(const Json& message);
    Json overlay(const Json& message);
    Json drag(const Json& message);
    Json pick(const Json& message);
    Json range(const Json& message);
    Json transfer(const Json& message);
    Json line(const Json& message);
    Json histogram(const Json& message);
    Json palette(const Json& message);
    Json undecided(const Json& message);
    Json save_scene(const Json& message);
    Json save_picture(const Json& message);
    Json integrate(const Json& message);
    Json extrema(const Json& message);
    Json film(const Json& message);
    Json film_picture(const Json& message);
    Json stop_long(const Json& message);
    Json shown(const Json& message);
    /** Throws Error if there would be nothing to see. */
    void move_camera(const Camera& camera);
    void set_camera(const Camera& camera, bool is_moving);
    /**
     * A scene of the page, in full form and with a whole camera, if the library takes it and it suits the volume; throws what
     * they say otherwise.
     */
    Scene judged(const Json& scene) const;
    /** What did not suit the volume before may go on. */
    void check_suits(const elvis::scene& wanted) const;
    /** As near as it sees all of the volume. */
    Camera fitted(const Camera& camera) const;
    void edit(const std::string& what, const Json& scene);
    void edited(bool is_moving);
    /** A picture may have that size: see message_values.hpp, memory_limit.hpp. */
    void check_size(const Scene& scene, const std::array<std::uint32_t, 2>& size) const;
    /** For what the scene shows more than before. */
    void need_memory_of_items(const Scene& scene) const;
    /** A step of its own. */
    void change_items(const std::string& what, Scene&& scene);
    /** `is_awaited`: before the next picture. */
    void post(const Json& message, std::string activity, Job job, bool is_awaited = true);
    /** Throws Error if there is one already. */
    void post_long(const Json& message, std::string activity, Job job);
    void need_no_film() const;
    /** What takes long, and the film. */
    void stop_long_of(Member asker);
    /** Of a picture that is saved. */
    std::array<std::uint32_t, 2> saved_size(const Json& message) const;
    view::ItemId item_of(const Json& message) const;
    /** What a message names, or what the scene shows. */
    std::string field_of(const Json& message) const;
    Json overlay_json() const;
    Json hello() const;
    Json state() const;
    Json volume() const;

    // Who is there: session_members.cpp. With the lock held.
    bool is_member(Member member) const { return member == m_page || m_companions.contains(member); }
    /** To the page. */
    void send(const Json& message, const std::string& bytes = {});
    void send_to(Member member, const Json& message, const std::string& bytes = {});
    void tell_companions(const Json& message, Member but = nullptr);
    void tell_state();
    void tell_camera();

    // Pictures: session.cpp. With the lock held.
    void changed(bool is_moving);
    void run(const std::stop_token& stop);
    /** The picture to draw now, if one is wanted and may be sent. */
    std::optional<FrameSchedule::Step> next_step(Clock::time_point now) const;
    bool has_work(Clock::time_point now) const;
    /** Work that is stopped when something else is wanted, and where it takes too much memory. Without the lock. */
    Encoded watched(const std::function<Encoded(const task& watch)>& work, const task& outer);
    /** These open the lock while they work. */
    void do_task(std::unique_lock<std::mutex>& lock, std::deque<Task>& tasks);
    void do_long_task(std::unique_lock<std::mutex>& lock);
    /** Not while things move. */
    bool may_do_long_task(Clock::time_point now) const;
    void cancel_long_task();
    /** Of a task whose asker is told now and then how far it has come. */
    std::function<void(double, const char*)> progress_of(const Task& task);
    void draw(std::unique_lock<std::mutex>& lock, const FrameSchedule::Step& step);
    void send_frame(const FrameSchedule::Step& step, Encoded&& drawn, const Json& told);
    void cancel_outdated(Clock::time_point now);
    /** Fewer pixels where the line is slow, more where it is not. */
    void adapt(double milliseconds);

    std::shared_ptr<const Served> m_served;
    std::string m_id;
    mutable std::mutex m_mutex;
    std::condition_variable_any m_changed;
    Member m_page = nullptr;
    /** The page's. */
    Send m_send;
    std::map<Member, Send> m_companions;
    /** Whose message is being worked on. */
    Member m_asker = nullptr;
    view::Model m_model;
    /** While a handle is dragged: the scene before. */
    std::optional<Scene> m_taken;
    /** Points whose places in the picture the page is told. */
    std::vector<Vector3> m_marked;
    /** Grows with what is selected or marked; a frame may come that was begun before. */
    std::uint64_t m_overlay_version = 0;
    FrameSchedule m_schedule{20};
    /** Before the next picture, and when no picture is wanted. */
    std::deque<Task> m_tasks, m_later;
    /** One at a time. */
    std::optional<LongTask> m_long;
    std::optional<BegunFilm> m_film;
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
    /** The camera is still that of the first scene, for the size of the page. */
    bool m_is_first_view = true;
    /** How often exact pictures made way for others. */
    int m_n_yields = 0;
    std::atomic<bool> m_cancelled = false;
    /** After all else, so that it stops first. */
    std::jthread m_thread;
};

} // namespace elvis::serve
