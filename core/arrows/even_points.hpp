/**
 * @file even_points.hpp
 * Points of a surface, evenly spaced.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace elvis {

/**
 * Chooses from candidates, which cover a surface closely, until there is no room for one more: no two are nearer to each other
 * than `distance` (> 0). The next one is always that which lies nearest to two that are chosen: on smooth surfaces they become
 * a lattice of triangles, where candidates are close enough together, and they begin anew in each part of the surface.
 *
 * `place`: where a candidate goes if it is chosen, near to where it is; nothing if it cannot be. It is asked once at most.
 * Returns those that are chosen.
 */
std::vector<std::size_t> choose_evenly(const std::vector<Vector3>& candidates, double distance,
                                       const std::function<std::optional<Vector3>(std::size_t candidate)>& place);

} // namespace elvis
