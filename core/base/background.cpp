#include <core/base/background.hpp>

namespace elvis {

void Background::Work::begin() {
    {
        const std::lock_guard lock(m_mutex);
        if (m_state != State::waiting) {
            return;
        }
        m_state = State::running;
    }
    std::exception_ptr thrown;
    try {
        const HostScope scope(m_host);
        m_what();
    } catch (...) {
        thrown = std::current_exception();
    }
    // What the work holds is let go by the thread that did it, before others go on.
    m_what = nullptr;
    const std::lock_guard lock(m_mutex);
    m_thrown = thrown;
    m_state = State::done;
    m_is_done.notify_all();
}

void Background::Work::wait() {
    begin();
    std::unique_lock lock(m_mutex);
    m_is_done.wait(lock, [this] { return m_state == State::done; });
    if (m_thrown) {
        std::rethrow_exception(m_thrown);
    }
}

void Background::Work::drop() {
    std::unique_lock lock(m_mutex);
    if (m_state == State::waiting) {
        m_state = State::done;
        m_what = nullptr;
    }
    m_is_done.wait(lock, [this] { return m_state == State::done; });
}

Background::~Background() {
    {
        const std::lock_guard lock(m_mutex);
        m_is_over = true;
        m_queue.clear();
    }
    m_has_work.notify_all();
    for (std::thread& thread : m_threads) {
        thread.join();
    }
}

std::shared_ptr<Background::Work> Background::hand_over(std::function<void()> what) {
    auto work = std::make_shared<Work>(std::move(what));
    const std::lock_guard lock(m_mutex);
    while (m_threads.size() < m_n_threads) {
        m_threads.emplace_back([this] { serve(); });
    }
    m_queue.push_back(work);
    m_has_work.notify_one();
    return work;
}

void Background::finish() {
    std::unique_lock lock(m_mutex);
    while (!m_queue.empty()) {
        do_next(lock);
    }
    m_is_idle.wait(lock, [this] { return m_n_running == 0; });
}

void Background::serve() {
    std::unique_lock lock(m_mutex);
    while (true) {
        m_has_work.wait(lock, [this] { return m_is_over || !m_queue.empty(); });
        if (m_is_over) {
            return;
        }
        do_next(lock);
    }
}

void Background::do_next(std::unique_lock<std::mutex>& lock) {
    const std::shared_ptr<Work> next = std::move(m_queue.front());
    m_queue.pop_front();
    ++m_n_running;
    lock.unlock();
    next->begin();
    lock.lock();
    --m_n_running;
    m_is_idle.notify_all();
}

} // namespace elvis
