/**
 * @file palette.hpp
 * What colour maps look like.
 */
#pragma once

#include <core/scene/scene.hpp>

#include <nlohmann/json.hpp>

namespace elvis::serve {

/** [position, r, g, b] from 0 to 1, linear in between and within a hundredth of a colour of the map. */
nlohmann::json palette_of(const SceneColorMap& map);

} // namespace elvis::serve
