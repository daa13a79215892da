/**
 * @file render_session.hpp
 * What pictures that are drawn one after the other have in common.
 */
#pragma once

#include "render_options.hpp"

#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/renderer.hpp>

#include <optional>

namespace elvis::commands {

/** The device, and the last scene's volume and renderer: the next scene of that volume finds its data and kernels there. */
class RenderSession {
public:
    explicit RenderSession(const RenderArguments& arguments);

    /** Opens the scene's volume unless it is open. What was opened before is gone if it is another. */
    void open(const Scene& scene);

    /** These are there once a volume was opened. */
    const Device& device() const { return *m_device; }
    const RuntimeVolume& volume() const { return *m_volume; }
    Renderer& renderer() { return *m_renderer; }
    /** What opening the volume took; 0 if it was open. */
    double load_milliseconds() const { return m_load_milliseconds; }

private:
    const RenderArguments& m_arguments;
    PluginRegistry m_registry;
    std::optional<Device> m_device;
    std::optional<RuntimeVolume> m_volume;
    std::optional<Renderer> m_renderer;
    /** Of what is open. */
    std::string m_path, m_plugin, m_plugin_options;
    Precision m_precision = Precision::float32;
    double m_load_milliseconds = 0;
};

} // namespace elvis::commands
