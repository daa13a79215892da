/**
 * @file resolve.hpp
 * Fills in what a scene leaves open, from facts about the volume.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/scene/scene.hpp>

#include <array>
#include <span>
#include <string>

namespace elvis {

/**
 * Camera with everything decided. Defaults: looks at the centre of the bounds (min x y z, max x y z), at the first cut plane
 * from its front or along a diagonal, sees the whole of the bounds; up is +y, or +z when looking along y. Throws Error where
 * eye and look_at coincide or up is parallel to the view.
 */
Camera resolve_camera(const SceneCamera& camera, const std::array<double, 6>& bounds, std::span<const CutPlane> planes,
                      double aspect);

/**
 * Distance from `look_at`, in the unit direction `to_eye`, at which every corner of the bounds is in the picture, with a
 * margin.
 */
double fitting_distance(const std::array<double, 6>& bounds, const Vector3& look_at, const Vector3& to_eye, const Vector3& up,
                        double field_of_view, double aspect);

/** The plane through the centre of the bounds across their shortest extent. */
CutPlane central_plane(const std::array<double, 6>& bounds);

/** The plane in which flat bounds lie; nothing for others. */
std::vector<CutPlane> plane_of_flat(const std::array<double, 6>& bounds);

} // namespace elvis
