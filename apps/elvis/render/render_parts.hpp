/**
 * @file render_parts.hpp
 * Pictures of volumes that are drawn in parts.
 */
#pragma once

#include "render_options.hpp"

#include <elvis/elvis.hpp>

namespace elvis::commands {

/** Throws UsageError for options that do not go with --parts, and for several processes without it. */
void check_parts(const RenderArguments& arguments, bool is_animation);

/** Draws one scene; its files are written by the first process of the team. */
void render_parts(const RenderArguments& arguments, const scene& shown);

} // namespace elvis::commands
