/**
 * @file scene_places.hpp
 * Evenly spaced points of a volume, or on a surface of a scene: where arrows stand and streamlines begin.
 */
#pragma once

#include <core/arrows/arrow_seeds.hpp>
#include <core/base/cancel.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/scene/scene.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

/** What the points are for, as errors say it. */
struct PlacesUse {
    std::string what, verb;
};

/** What is wanted, or else 0.05 of the diagonal of the volume's bounds. */
double spacing_of(const std::optional<double>& wanted, const std::array<double, 6>& bounds);

/** Null for an empty name. Throws Error where the scene has no surface of that name. */
const SceneSurface* surface_under(const std::string& name, const Scene& scene, const PlacesUse& use);

/** All of the scene that the points rest on, but for what is asked of them; of a null surface nothing. */
std::string places_key(const SceneSurface* under, const Scene& scene);

/**
 * Of the surface, without what is clipped away with it; of the volume if null. `spacing`: in the world, > 0. `bounds`: of the
 * volume, which evaluates whole elements on the CPU. Throws Error for surfaces that have no such points.
 */
std::vector<ArrowSeed> scene_places(const SceneSurface* under, double spacing, const Scene& scene, const RuntimeVolume& volume,
                                    const std::array<double, 6>& bounds, const PlacesUse& use, const TaskControl& control);

} // namespace elvis
