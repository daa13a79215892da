/**
 * @file animation_pictures.hpp
 * The pictures of a scene's animation, whose colours mean the same in all of them.
 */
#pragma once

#include <core/session/missed_surfaces.hpp>
#include <core/session/still_picture.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace elvis {

/** Time steps that the scene's animation shows; none if it has no animation, or one of a camera's path alone. */
std::vector<std::uint32_t> steps_of_animation(const Scene& scene, const RuntimeVolume& volume);

/** One thread at a time. */
class AnimationPictures {
public:
    /** Of a scene with an animation; the volume must outlive it. Throws Error where the scene does not suit the volume. */
    AnimationPictures(Scene scene, const RuntimeVolume& volume, VolumeRanges& ranges);

    const std::vector<AnimationFrame>& frames() const { return m_frames; }
    double frames_a_second() const { return m_scene.animation->frames_a_second; }

    /** What is to be known of a time step comes with the first picture of it. */
    StillPicture draw(std::size_t frame, Renderer& renderer, const StillOptions& options, const TaskControl* control = nullptr);

    /** What all pictures that were drawn so far do not show, a sentence each. */
    std::vector<std::string> missed(VolumeRanges& ranges) const;

private:
    const FrameRequest& request_of(std::uint32_t time_step, VolumeRanges& ranges);

    Scene m_scene;
    const RuntimeVolume& m_volume;
    /** By time step. */
    std::map<std::uint32_t, FrameRequest> m_requests;
    /** Time steps of which there was a picture. */
    std::set<std::uint32_t> m_drawn_steps;
    std::vector<AnimationFrame> m_frames;
    MissedSurfaces m_missed;
};

} // namespace elvis
