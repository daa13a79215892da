#include "sessions.hpp"
#include "memory_limit.hpp"

#include <apps/serve/network/token.hpp>

#include <core/base/error.hpp>
#include <core/base/memory.hpp>

#include <utility>

namespace elvis::serve {

std::shared_ptr<Session> Sessions::find_or_make(const std::string& id) {
    if (const auto found = m_entries.find(id); found != m_entries.end()) {
        return found->second.session;
    }
    if (m_entries.size() >= m_most) {
        const auto longest = longest_alone();
        if (longest == m_entries.end()) {
            throw Error("there are as many sessions as there may be (--sessions)");
        }
        m_entries.erase(longest);
    }
    make_room();
    need_memory(*m_served, session_bytes);
    const std::string name = random_digits(16);
    auto session = std::make_shared<Session>(m_served, name);
    m_entries[name] = {session, nullptr, {}, Clock::now()};
    return session;
}

void Sessions::attached(const std::string& id, Member member, bool is_companion) {
    const auto found = m_entries.find(id);
    if (found == m_entries.end()) {
        return;
    }
    if (is_companion) {
        found->second.companions.insert(member);
    } else {
        found->second.page = member;
    }
}

void Sessions::detached(const std::string& id, Member member) {
    const auto found = m_entries.find(id);
    if (found == m_entries.end()) {
        return;
    }
    Entry& entry = found->second;
    entry.companions.erase(member);
    entry.page = entry.page == member ? nullptr : entry.page;
    entry.detached = entry.is_alone() ? Clock::now() : entry.detached;
    entry.session->detach(member);
}

void Sessions::end_old() {
    std::erase_if(m_entries, [](const auto& entry) {
        return entry.second.is_alone() && Clock::now() - entry.second.detached > session_patience;
    });
}

Sessions::Entries::iterator Sessions::longest_alone() {
    auto longest = m_entries.end();
    for (auto entry = m_entries.begin(); entry != m_entries.end(); ++entry) {
        if (entry->second.is_alone() && (longest == m_entries.end() || entry->second.detached < longest->second.detached)) {
            longest = entry;
        }
    }
    return longest;
}

void Sessions::make_room() {
    if (!is_memory_exceeded(*m_served)) {
        m_is_short = false;
        return;
    }
    m_served->library.free_memory();
    for (auto longest = longest_alone(); longest != m_entries.end() && is_memory_exceeded(*m_served);
         longest = longest_alone()) {
        m_entries.erase(longest);
        m_served->library.free_memory();
    }
    if (is_memory_exceeded(*m_served) && !std::exchange(m_is_short, true)) {
        for (const auto& [id, entry] : m_entries) {
            entry.session->spare_memory();
        }
    }
}

void Sessions::stop_all() {
    for (const auto& [id, entry] : m_entries) {
        entry.session->stop();
    }
    m_entries.clear();
}

} // namespace elvis::serve
