/**
 * @file animation_pictures.hpp
 * The pictures of a scene's animation, whose colours mean the same in all of them.
 */
#pragma once

#include <core/session/missed_surfaces.hpp>
#include <core/session/still_picture.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace elvis {

/** Time steps that the scene's animation shows; none if it has no animation, or one of a camera's path alone. */
std::vector<std::uint32_t> steps_of_animation(const Scene& scene, const RuntimeVolume& volume);

/** One thread at a time. */
class AnimationPictures {
public:
    /** Of a scene with an animation. Throws Error where the scene does not suit the volume. */
    AnimationPictures(Scene scene, const RuntimeVolume& volume, PictureRanges& ranges);

    const std::vector<AnimationFrame>& frames() const { return m_frames; }
    double frames_a_second() const { return m_scene.animation->frames_a_second; }

    /** What a picture shows, but for its camera: the scene at that time step and phase. */
    Scene scene_of(std::size_t frame) const;

    /**
     * What is to be known of a time step comes with the first picture of it. `shown` is scene_of(frame), whose streamlines have
     * their tubes; `volume`, which `renderer` draws, is displaced as it says.
     */
    StillPicture draw(std::size_t frame, const Scene& shown, const RuntimeVolume& volume, Renderer& renderer,
                      const StillOptions& options, const TaskControl* control = nullptr);
    /** The same by something else that draws the picture of a request. */
    using DrawRequest = std::function<StillPicture(const Scene& scene, FrameRequest request)>;
    StillPicture draw(std::size_t frame, const Scene& shown, const RuntimeVolume& volume, PictureRanges& ranges,
                      const DrawRequest& draw_it);

    /** What all pictures that were drawn so far do not show, a sentence each. */
    std::vector<std::string> missed(PictureRanges& ranges) const;

private:
    /** A time step and a phase. */
    using Moment = std::pair<std::uint32_t, double>;

    static Moment moment_of(const AnimationFrame& frame) { return {frame.time_step, frame.phase.value_or(0)}; }
    const FrameRequest& request_of(const Scene& scene, Moment moment, const RuntimeVolume& volume, PictureRanges& ranges);

    Scene m_scene;
    std::map<Moment, FrameRequest> m_requests;
    /** Of which there was a picture. */
    std::set<Moment> m_drawn;
    std::vector<AnimationFrame> m_frames;
    MissedSurfaces m_missed;
};

} // namespace elvis
