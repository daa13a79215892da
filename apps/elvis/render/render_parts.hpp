/**
 * @file render_parts.hpp
 * Pictures of volumes that are drawn in parts.
 */
#pragma once

#include "render_options.hpp"

#include <elvis/elvis.hpp>

namespace elvis::commands {

/** Draws one scene, or its animation; files are written by the first process of the team, or of each of its groups. */
void render_parts(const RenderArguments& arguments, const scene& shown);

} // namespace elvis::commands
