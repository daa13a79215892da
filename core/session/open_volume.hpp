/**
 * @file open_volume.hpp
 * Opening a volume by its path.
 */
#pragma once

#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <string>

namespace elvis {

/**
 * Opens with the plugin of that id, or the one surest of the file. A foreign file gets the advice to convert it. `control`, if
 * there is one, must outlive the volume.
 */
inline RuntimeVolume open_volume(const PluginRegistry& registry, const std::string& path, const std::string& plugin,
                                 const std::string& options, const TaskControl* control = nullptr) {
    if (!plugin.empty()) {
        return RuntimeVolume(registry.find(plugin), path, options, control);
    }
    std::shared_ptr<const Plugin> found;
    try {
        found = registry.runtime_for(path);
    } catch (const Error& error) {
        bool is_foreign = true;
        try {
            registry.converter_for(path);
        } catch (const Error&) {
            is_foreign = false;
        }
        if (!is_foreign) {
            throw;
        }
        throw Error(path, "is a foreign file; convert it first: elvis convert " + path + " -o volume.h5");
    }
    return RuntimeVolume(found, path, options, control);
}

} // namespace elvis
