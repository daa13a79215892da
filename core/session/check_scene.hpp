/**
 * @file check_scene.hpp
 * Whether a scene suits a volume, found before anything is drawn.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/scene/scene.hpp>

namespace elvis {

/**
 * Throws Error as a picture would for fields and expressions of the scene that the volume has not, or that are none, and for
 * conditions, flows and choices of elements that do not suit it. Items that are hidden count, too. Nothing is asked of the
 * device, nor of the volume but its fields and times: for any thread, also while the volume is drawn.
 */
void check_scene(const Scene& scene, const RuntimeVolume& volume);

} // namespace elvis
