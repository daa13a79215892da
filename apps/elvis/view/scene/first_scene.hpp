/**
 * @file first_scene.hpp
 * What is shown first of a volume that no scene speaks of.
 */
#pragma once

#include "scene.hpp"

#include <elvis/elvis.hpp>

#include <string>
#include <vector>

namespace elvis::view {

/** Of open data of these files: the surfaces of `elvis render`, with annotation, and lit where there are faces. */
Scene first_scene(const context& library, const data& volume, const std::vector<std::string>& files);

} // namespace elvis::view
