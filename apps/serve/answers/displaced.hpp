/**
 * @file displaced.hpp
 * The volume as a scene displaces it.
 */
#pragma once

#include <apps/serve/served.hpp>

#include <optional>

namespace elvis::serve {

/** Nothing if the scene has no warp: then it is the volume itself. */
std::optional<data> displaced(const Served& served, const Scene& scene, const task& watch);

} // namespace elvis::serve
