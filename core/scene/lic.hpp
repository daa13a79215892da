/**
 * @file lic.hpp
 * Line integral convolution as scenes ask for it.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/surface.hpp>
#include <core/scene/scene.hpp>

namespace elvis {

/**
 * What the renderer is asked for, in pictures of the scene's size. Throws Error where the field is no vector: of three
 * components, or in two dimensions of two, then without a part across.
 */
Lic lic_of(const SceneLic& own, const Scene& scene, const RuntimeVolume& volume);

} // namespace elvis
