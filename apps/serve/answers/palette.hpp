/**
 * @file palette.hpp
 * What colour maps look like.
 */
#pragma once

#include <apps/serve/served.hpp>

#include <nlohmann/json.hpp>

namespace elvis::serve {

/** Of a scene's "color_map": [position, r, g, b] from 0 to 1, linear in between and within 1e-4 of a colour of the map. */
nlohmann::json palette_of(const Served& served, nlohmann::json map);

} // namespace elvis::serve
