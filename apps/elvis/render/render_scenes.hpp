/**
 * @file render_scenes.hpp
 * What `elvis render` does once it knows what is wanted.
 */
#pragma once

#include "render_options.hpp"

namespace elvis::commands {

/**
 * Draws the scene, or a picture of the volume, that `inputs` names. Several inputs are scenes: a picture of each, or an
 * animation, goes into the folder `output` under the scene's name. Scenes are read, and names looked at, before anything is
 * drawn.
 */
void render_scenes(const RenderArguments& arguments);

} // namespace elvis::commands
