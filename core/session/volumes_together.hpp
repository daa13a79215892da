/**
 * @file volumes_together.hpp
 * Several volumes in one picture: two time steps, or two solvers, side by side.
 *
 * Each volume's picture is drawn from where the camera is to the volume: the volume is moved by moving the camera, and lights,
 * the other way. Of each pixel the nearest surface is then shown, as all depths are lengths along the same ray.
 */
#pragma once

#include <core/session/still_picture.hpp>

#include <cstddef>
#include <span>

namespace elvis {

/** What one of them shows, and who draws it. */
struct VolumeInPicture {
    /** Without further volumes. */
    Scene scene;
    /** By which it is moved. */
    Vector3 offset{};
    const RuntimeVolume* volume = nullptr;
    Renderer* renderer = nullptr;
};

/** What a scene shows of itself (number 0), or of its further volumes: what these do not say is as the scene has it. */
Scene scene_of_volume(const Scene& scene, std::size_t number);

/** Throws Error if the scene has what is not drawn of several volumes: what can be seen through, and what has no depth. */
void need_drawable_together(const Scene& scene);

/**
 * The picture of all; `volumes` in the order of the scene, at least one. They have one camera, by default such that all of them
 * are seen, and colours mean the same: where a scene gives no range, it is that of a surface's field in all volumes, whatever
 * its name is there.
 *
 * Doubt of any volume's picture stays. Where surfaces of two volumes are nearer to each other than depths are exact, the first
 * volume is shown, and the pixel is undecided (256). Lines where one volume's picture ends in front of another are undecided
 * (2, 512): neither picture knows what part of the pixel the other one hides. Elements have the numbers of their own volume.
 */
StillPicture draw_together(std::span<const VolumeInPicture> volumes, const StillOptions& options, const TaskControl* control);

} // namespace elvis
