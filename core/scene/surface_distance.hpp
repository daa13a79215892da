/**
 * @file surface_distance.hpp
 * The distance to a surface of the scene, as a part of expressions.
 */
#pragma once

#include <core/scene/scene.hpp>

#include <span>
#include <string>

namespace elvis {

/**
 * `text` with every distance(NAME) replaced by an expression in x, y and z: the signed distance to the surface of that name,
 * which is negative on the side from which a plane's normal points, and inside spheres, tori, and cylinders and cones with
 * caps. Pipes, which are open, have no inside: theirs is never negative. Throws Error where there is no such surface, or its
 * distance has no closed form. What is quoted stays.
 */
std::string with_distances(const std::string& text, std::span<const SceneSurface> surfaces);

} // namespace elvis
