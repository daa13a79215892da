/**
 * @file open_volume.hpp
 * From the files that people have to a volume that can be drawn.
 */
#pragma once

#include <core/base/temporary_folder.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <memory>
#include <string>
#include <vector>

namespace elvis {

/** What is drawn: the user's own file, or the native volume that a conversion made of it. */
struct VolumeFile {
    std::shared_ptr<const Plugin> plugin;
    std::string path;
    /** Of the plugin, JSON or empty. */
    std::string options;
    /** Without a cache: what holds the native volume, which goes with it. */
    std::shared_ptr<const TemporaryFolder> folder;

    /** `control`, if there is one, must outlive the volume. */
    RuntimeVolume open(const TaskControl* control = nullptr) const { return {plugin, path, options, control}; }
};

/**
 * By the plugin of that id, or the one surest of the first file. What no runtime plugin opens, and several files, are one
 * foreign data set: it is converted, and the conversion is kept in the cache (core/convert/kept_volumes.hpp). A file that
 * nobody reads gets a message that says what it seems to be.
 */
VolumeFile find_volume(const PluginRegistry& registry, const std::vector<std::string>& paths, const std::string& plugin,
                       const std::string& options, const TaskControl& control);

} // namespace elvis
