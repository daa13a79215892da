/**
 * @file background.hpp
 * Work that other threads do while the one that wants its result goes on.
 */
#pragma once

#include <core/base/host.hpp>

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace elvis {

/** Threads that do what they are handed, first come first served. They begin with the first piece of work. */
class Background {
public:
    /** A piece of work. It is done once, by a thread of the background or by the first who waits for it. */
    class Work {
    public:
        explicit Work(std::function<void()> what) : m_what(std::move(what)), m_host(host()) {}

        /** Returns when the work is done: does it here if nobody has begun. Throws what the work has thrown, each time. */
        void wait();
        /** It is not done any more if nobody has begun; else this returns when it is done. Throws nothing. */
        void drop();
        /** Does the work if nobody has begun. */
        void begin();

    private:
        enum class State { waiting, running, done };

        std::function<void()> m_what;
        /** Of the thread that handed it over. */
        const Host& m_host;
        std::mutex m_mutex;
        std::condition_variable m_is_done;
        State m_state = State::waiting;
        std::exception_ptr m_thrown;
    };

    explicit Background(unsigned n_threads) : m_n_threads(n_threads) {}
    /** Returns when no thread is at work. What nobody has begun is left to those who wait for it. */
    ~Background();
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;

    /** From any thread. */
    std::shared_ptr<Work> hand_over(std::function<void()> what);
    /** Returns when all that was handed over is done; takes its part in it. Throws nothing: those who wait for a piece learn.
     */
    void finish();

private:
    void serve();
    /** Does the first piece of the queue, with the lock let go meanwhile. */
    void do_next(std::unique_lock<std::mutex>& lock);

    unsigned m_n_threads;
    std::mutex m_mutex;
    std::condition_variable m_has_work, m_is_idle;
    std::size_t m_n_running = 0;
    std::deque<std::shared_ptr<Work>> m_queue;
    bool m_is_over = false;
    std::vector<std::thread> m_threads;
};

} // namespace elvis
