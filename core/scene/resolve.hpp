/**
 * @file resolve.hpp
 * Fills in what a scene leaves open, from facts about the volume.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/scene/picture_room.hpp>
#include <core/scene/scene.hpp>

#include <array>
#include <span>
#include <vector>

namespace elvis {

/** What a camera is to show. */
struct VolumeExtent {
    /** min x y z, max x y z */
    std::array<double, 6> bounds{};
    /** core/volume/outline.hpp; the bounds' corners count if it is empty. */
    std::vector<Vector3> outline;
};

/** Whether the scene says where its camera stands, in part or in whole; otherwise the volume is to fill the picture. */
bool is_placed(const SceneCamera& camera);

/**
 * The scene's camera with everything decided. Defaults: looks at the centre of the bounds, at the first of `planes` from its
 * front or along a diagonal; up is +y, or +z when looking along y. A camera that is not placed is as near as it can be with the
 * volume in the room that annotation leaves, in all pictures of a turntable; one that is placed in part sees the whole of the
 * bounds. Throws Error where eye and look_at coincide or up is parallel to the view.
 */
Camera resolve_camera(const Scene& scene, const VolumeExtent& extent, std::span<const CutPlane> planes);

/** Says all of a camera, but for `near`, which stays. */
void set_camera(SceneCamera& own, const Camera& camera);

/** From the same direction, the volume fills the room. */
Camera fitted(const Camera& camera, const VolumeExtent& extent, const PictureRoom& room);

/** The plane through the centre of the bounds across their shortest extent. */
CutPlane central_plane(const std::array<double, 6>& bounds);

/** The plane in which flat bounds lie; nothing for others. */
std::vector<CutPlane> plane_of_flat(const std::array<double, 6>& bounds);

} // namespace elvis
