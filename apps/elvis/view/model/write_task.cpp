#include "write_task.hpp"

namespace elvis::view {

void WriteTask::begin() {
    const std::lock_guard lock(m_mutex);
    m_is_cancelled = false;
    m_is_running = true;
    m_fraction = -1;
    m_activity.clear();
}

std::pair<double, std::string> WriteTask::progress() const {
    const std::lock_guard lock(m_mutex);
    return {m_fraction, m_activity};
}

task WriteTask::watch() {
    return {[this](double fraction, const char* activity) {
                const std::lock_guard lock(m_mutex);
                m_fraction = fraction;
                m_activity = activity;
            },
            [this] { return m_is_cancelled.load(); }};
}

} // namespace elvis::view
