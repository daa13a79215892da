/**
 * @file native_volume.hpp
 * Volumes that are drawn in parts: native ones, and what is converted to them.
 */
#pragma once

#include <core/base/team.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/scene/scene.hpp>
#include <core/session/volume/open_volume.hpp>

#include <elvis/native/volume_source.hpp>

#include <memory>
#include <vector>

namespace elvis::commands {

/** What a volume's numbers come from, and the volume that serves them. */
struct NativeVolume {
    /** Its own, then those joined to it: they hold temporary files. */
    std::vector<VolumeFile> files;
    std::shared_ptr<const native::VolumeSource> source;
    RuntimeVolume whole;
};

/** Called by all of the team; what has to be converted, the first converts. */
NativeVolume open_native(const Scene& scene, const PluginRegistry& plugins, Team& team, const TaskControl& control);

} // namespace elvis::commands
