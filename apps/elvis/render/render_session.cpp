#include "render_session.hpp"

#include <core/base/milliseconds.hpp>

#include <nlohmann/json.hpp>

#include <chrono>

namespace elvis::commands {

data& RenderSession::open(const scene& shown, const task& watch) {
    const nlohmann::json volume = nlohmann::json::parse(shown.json("/volume"));
    const std::string path = shown.volume(), plugin = volume.value("plugin", "");
    const std::string options = volume.contains("options") ? volume["options"].dump() : "";
    std::string key = path;
    key += '\n' + plugin + '\n' + options;
    m_load_milliseconds = 0;
    if (!m_data || key != m_key) {
        m_data.reset();
        const auto start = std::chrono::steady_clock::now();
        m_data.emplace(m_library.open(path, plugin, options, watch));
        m_load_milliseconds = milliseconds_since(start);
        m_key = std::move(key);
    }
    return *m_data;
}

} // namespace elvis::commands
