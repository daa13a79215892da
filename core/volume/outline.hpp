/**
 * @file outline.hpp
 * How far a volume reaches in every direction.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/base/vector3.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <vector>

namespace elvis {

/**
 * Points of the volume, one for each of some directions all around: the farthest of samples of its mapping. A picture that
 * shows all of them shows the volume, but for about three percent of its size. Of a plugin that evaluates no mappings on the
 * CPU they are corners of the elements' bounds, beyond which nothing is. The background fetches bounds.
 */
std::vector<Vector3> outline_points(const RuntimeVolume& volume, Background& background);
/** With bounds that are known: six numbers an element. */
std::vector<Vector3> outline_points(const RuntimeVolume& volume, const std::vector<double>& boxes);

} // namespace elvis
