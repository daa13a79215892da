/**
 * @file sessions.hpp
 * Who looks at the volume: sessions by their names, for some minutes also without a page. For one thread.
 */
#pragma once

#include "session.hpp"

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>

namespace elvis::serve {

/** So long a session waits for its page to come back. */
inline constexpr std::chrono::minutes session_patience{10};

class Sessions {
public:
    Sessions(std::shared_ptr<const Served> served, std::size_t most) : m_served(std::move(served)), m_most(most) {}

    /**
     * The one of that name, or a new one, in place of the one that has waited longest for its page if there are too many.
     * Throws Error if all have theirs, or there is no memory for another one.
     */
    std::shared_ptr<Session> find_or_make(const std::string& id);
    /** A page that comes to a session takes it from the one before; companions come beside it. */
    void attached(const std::string& id, Member member, bool is_companion);
    void detached(const std::string& id, Member member);
    void end_old();
    /** Where more memory is held than may be: sessions without pages end, and the others forget steps of undo, and are told. */
    void make_room();
    void stop_all();

private:
    using Clock = std::chrono::steady_clock;
    struct Entry {
        std::shared_ptr<Session> session;
        Member page = nullptr;
        std::set<Member> companions;
        Clock::time_point detached{};

        bool is_alone() const { return page == nullptr && companions.empty(); }
    };

    std::shared_ptr<const Served> m_served;
    std::size_t m_most;
    using Entries = std::map<std::string, Entry>;
    /** The one that has waited longest for its page; the end if all have theirs. */
    Entries::iterator longest_alone();

    Entries m_entries;
    bool m_is_short = false;
};

} // namespace elvis::serve
