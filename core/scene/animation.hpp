/**
 * @file animation.hpp
 * Pictures one after the other: over time steps or phases, along a path of the camera, or both.
 */
#pragma once

#include <core/render/frame.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

/** Time steps from `first` to `last`, every `stride`th; all if `last` is absent. Backwards if last < first. */
struct TimeStepRange {
    std::uint32_t first = 0;
    std::optional<std::uint32_t> last;
    std::uint32_t stride = 1;
};

/** The eye goes around what the camera looks at; up turns with it. */
struct Turntable {
    std::uint32_t n_frames = 0;
    /** The camera's up if absent. */
    std::optional<Vector3> axis;
    /** In all; seen from the end of the axis the eye goes counterclockwise if > 0. */
    double degrees = 360;
};

/** What the camera is in one picture of a path. What is absent is as in the scene's camera. */
struct KeyFrame {
    std::uint32_t frame = 0;
    std::optional<Vector3> eye, look_at, up;
    std::optional<double> field_of_view, height;
};

struct SceneAnimation {
    std::optional<TimeStepRange> time_steps;
    /** Phases of the scene's warp, evenly over one period; 0: the scene's own. Not with time steps. */
    std::uint32_t n_phases = 0;
    /** At most one of these two. */
    std::optional<Turntable> turntable;
    /** At least two with their pictures ascending, the first being 0; or none. */
    std::vector<KeyFrame> key_frames;
    double frames_a_second = 25;
};

/** One picture of an animation. */
struct AnimationFrame {
    std::uint32_t time_step = 0;
    Camera camera;
    /** Degrees, where the animation has phases. */
    std::optional<double> phase = std::nullopt;
};

/** "all", "A:B" or "A:B:S" with whole numbers; nothing where the text is something else. */
std::optional<TimeStepRange> parse_time_steps(const std::string& text);

/** The steps of a range; an Error, which begins with `place`, if one does not exist. */
std::vector<std::uint32_t> steps_of(const TimeStepRange& range, std::size_t n_steps, const std::string& place);

/**
 * Cameras of a path: a turntable, whose last picture is one step before the first so that the film can go round and round; or
 * key frames, between which everything goes smoothly through all of them (cubic Hermite splines with Catmull-Rom tangents; of
 * the point looked at, of the logarithms of distance, angle and height, and of the orientation's quaternion); or `camera`
 * alone.
 */
std::vector<Camera> camera_path(const SceneAnimation& animation, const Camera& camera);

/**
 * All pictures: as many as the camera's path, the steps or the phases have, whichever is more; the others are spread evenly
 * over them.
 * Without steps all show `time_step`.
 */
std::vector<AnimationFrame> animation_frames(const SceneAnimation& animation, const std::vector<std::uint32_t>& steps,
                                             std::uint32_t time_step, const Camera& camera);

} // namespace elvis
