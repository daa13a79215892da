/**
 * @file volume_to_part.hpp
 * Volumes that are drawn in parts.
 */
#pragma once

#include <core/base/team.hpp>
#include <core/parts/parted_volume.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/scene/scene.hpp>
#include <core/session/volume/open_volume.hpp>

#include <elvis/native/volume_source.hpp>

#include <memory>
#include <string>
#include <vector>

namespace elvis::commands {

struct VolumeToPart {
    /** Its own, then those joined to it: they hold temporary files. */
    std::vector<VolumeFile> files;
    /** Of a native volume, or of what was converted to one: what its numbers come from. Else null. */
    std::shared_ptr<const native::VolumeSource> source;
    /** If it is displaced, what it comes from; else null. */
    std::shared_ptr<const native::VolumeSource> undeformed;
    RuntimeVolume whole;

    /** This and `control` must outlive it. Throws Error for a plugin without element records. */
    std::unique_ptr<PartedVolume> parted(const TaskControl& control) const {
        return source ? parted_native({source, undeformed}, whole, &control) : parted_by_plugin(whole);
    }
};

/** Called by all of the team; what has to be converted, the first converts. */
VolumeToPart open_to_part(const Scene& scene, const PluginRegistry& plugins, Team& team, const TaskControl& control);

/** Displaced as the scene's warp says, at the scene's time step; `name` stands for the volume in messages. */
VolumeToPart displaced(std::shared_ptr<const native::VolumeSource> undeformed, const Scene& scene, const std::string& name,
                       const TaskControl& control);

} // namespace elvis::commands
