/**
 * @file volume_argument.hpp
 * Opening the volume that a command is given.
 */
#pragma once

#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <string>

namespace elvis::commands {

/** Opens with the plugin of that id, or the one surest of the file. A foreign file gets the advice to convert it. */
inline RuntimeVolume open_volume(const PluginRegistry& registry, const std::string& path, const std::string& plugin,
                                 const std::string& options) {
    if (!plugin.empty()) {
        return RuntimeVolume(registry.find(plugin), path, options);
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
    return RuntimeVolume(found, path, options);
}

} // namespace elvis::commands
