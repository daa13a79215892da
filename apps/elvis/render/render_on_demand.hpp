/**
 * @file render_on_demand.hpp
 * Pictures within budgets of memory.
 */
#pragma once

#include "render_options.hpp"

#include <elvis/elvis.hpp>

namespace elvis::commands {

/** Whether --device-memory or --host-memory is given. */
bool has_budget(const RenderArguments& arguments);

/** Throws UsageError for sizes that are none, and for options that do not go with budgets. */
void check_budget(const RenderArguments& arguments, bool is_animation);

/** Draws one scene. */
void render_on_demand(const RenderArguments& arguments, const scene& shown);

} // namespace elvis::commands
