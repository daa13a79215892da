#include "render_session.hpp"

#include <core/base/milliseconds.hpp>
#include <core/session/open_volume.hpp>

#include <spdlog/spdlog.h>

#include <chrono>

namespace elvis::commands {

RenderSession::RenderSession(const RenderArguments& arguments) : m_arguments(arguments) {}

void RenderSession::open(const Scene& scene) {
    const Precision precision = scene.precision.value_or(Precision::float32);
    const bool is_open =
        m_volume && m_path == scene.volume && m_plugin == scene.plugin && m_plugin_options == scene.plugin_options;
    m_load_milliseconds = 0;
    if (!is_open) {
        m_renderer.reset();
        m_volume.reset();
        const auto start = std::chrono::steady_clock::now();
        m_volume.emplace(open_volume(m_registry, scene.volume, scene.plugin, scene.plugin_options));
        m_load_milliseconds = milliseconds_since(start);
        m_path = scene.volume;
        m_plugin = scene.plugin;
        m_plugin_options = scene.plugin_options;
    }
    if (!m_device) {
        m_device.emplace(m_arguments.device, m_arguments.validation);
        spdlog::info("device: {}", m_device->summary().name);
    }
    if (!m_renderer || m_precision != precision) {
        m_renderer.reset();
        m_renderer.emplace(*m_device, *m_volume, precision);
        m_precision = precision;
    }
}

} // namespace elvis::commands
