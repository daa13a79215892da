/**
 * @file complete_scene.hpp
 * Scenes that leave nothing open of what they show.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/field/volume_ranges.hpp>
#include <core/scene/scene.hpp>

namespace elvis {

/** The scene with its camera, and with surfaces if it shows nothing, as its picture has them. Throws Error as that would. */
Scene complete_scene(const Scene& scene, const RuntimeVolume& volume, VolumeRanges& ranges);

} // namespace elvis
