/**
 * @file first_scene.hpp
 * What is shown first of a volume that no scene speaks of.
 */
#pragma once

#include <core/scene/scene.hpp>

#include <elvis/elvis.hpp>

#include <string>

namespace elvis::view {

/** Of open data whose file is `path`: the surfaces of `elvis render`, with annotation, and lit where there are faces. */
Scene first_scene(const context& library, const data& volume, const std::string& path);

} // namespace elvis::view
