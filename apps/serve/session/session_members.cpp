#include "session.hpp"

namespace elvis::serve {

namespace {

Outgoing packed(const nlohmann::json& facts, const std::string& bytes) {
    if (bytes.empty()) {
        return {false, facts.dump()};
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
    return message;
}

} // namespace

void Session::attach(Member page, Send send) {
    const std::lock_guard lock(m_mutex);
    this->send({{"type", "taken"}});
    m_page = page;
    m_send = std::move(send);
    m_unconfirmed.clear();
    m_line = {};
    m_confirm_milliseconds = 0;
    m_schedule.change();
    m_failed_revision.reset();
    this->send(hello());
    this->send(state());
    m_changed.notify_all();
}

void Session::attach_companion(Member companion, Send send) {
    const std::lock_guard lock(m_mutex);
    m_companions[companion] = std::move(send);
    send_to(companion, hello());
    send_to(companion, state());
}

void Session::detach(Member member) {
    const std::lock_guard lock(m_mutex);
    for (std::deque<Task>* tasks : {&m_tasks, &m_later}) {
        std::erase_if(*tasks, [member](const Task& task) { return task.from == member; });
    }
    stop_long_of(member);
    m_companions.erase(member);
    if (member == m_page) {
        m_page = nullptr;
        m_send = {};
        m_cancelled = true;
    }
}

void Session::send(const Json& message, const std::string& bytes) {
    if (m_send) {
        m_send(packed(message, bytes));
    }
}

void Session::send_to(Member member, const Json& message, const std::string& bytes) {
    if (const auto companion = m_companions.find(member); companion != m_companions.end()) {
        companion->second(packed(message, bytes));
    } else if (member == m_page) {
        send(message, bytes);
    }
}

void Session::tell_companions(const Json& message, Member but) {
    for (const auto& [companion, send] : m_companions) {
        if (companion != but) {
            send(packed(message, {}));
        }
    }
}

void Session::tell_state() {
    const Json message = state();
    send(message);
    tell_companions(message);
}

void Session::tell_camera() {
    if (!m_companions.empty()) {
        tell_companions({{"type", "camera"}, {"camera", m_model.scene()["camera"]}});
    }
}

} // namespace elvis::serve
