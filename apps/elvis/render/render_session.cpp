#include "render_session.hpp"
#include <apps/elvis/open_volume.hpp>

#include <core/base/milliseconds.hpp>

#include <nlohmann/json.hpp>

#include <chrono>

namespace elvis::commands {

data& RenderSession::open(const scene& shown) {
    nlohmann::json volume = nlohmann::json::parse(shown.json("/volume"));
    volume.erase("time_step");
    std::string key = shown.volume() + '\n' + volume.dump();
    m_load_milliseconds = 0;
    if (!m_data || key != m_key) {
        m_data.reset();
        const auto start = std::chrono::steady_clock::now();
        m_data.emplace(open_watched([&](const task& watch) { return shown.open_volume(watch); }));
        m_load_milliseconds = milliseconds_since(start);
        m_key = std::move(key);
    }
    return *m_data;
}

} // namespace elvis::commands
