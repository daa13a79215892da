/**
 * @file render_animation.hpp
 * The pictures of an animation, numbered, and a film of them.
 */
#pragma once

#include "render_options.hpp"

#include <core/plugin_host/runtime_volume.hpp>
#include <core/render/renderer.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <vector>

namespace elvis::commands {

/** What is wrong with the arguments for an animation is said before anything is loaded. */
void check_animation(const RenderArguments& arguments, const Scene& scene);

/** Time steps that pictures are of; empty if it is the scene's own. `scene` has an animation. */
std::vector<std::uint32_t> drawn_steps(const Scene& scene, const RuntimeVolume& volume);

/**
 * Draws frame_0000.png and so on into the folder of -o. Each appears whole or not at all; with --resume those that are there
 * stay. `scene` has an animation.
 */
void render_animation(const RenderArguments& arguments, const Scene& scene, const Device& device, const RuntimeVolume& volume,
                      Renderer& renderer);

} // namespace elvis::commands
