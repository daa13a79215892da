/**
 * @file render_animation.hpp
 * The pictures of an animation, numbered, and a film of them.
 */
#pragma once

#include "render_options.hpp"

namespace elvis::commands {

/** What is wrong with the arguments for an animation is said before anything is loaded. */
void check_animation(const RenderArguments& arguments);

/**
 * Draws frame_0000.png and so on into the folder of -o. Each appears whole or not at all; with --resume those that are there
 * stay. The scene has an animation.
 */
void render_animation(const RenderArguments& arguments, const scene& shown, const data& volume, const context& library);

} // namespace elvis::commands
