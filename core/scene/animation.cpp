#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/scene/animation.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

namespace elvis {

namespace {

using Eigen::Quaterniond;
using Vector = Eigen::Vector3d;

Vector vector(const Vector3& a) { return {a[0], a[1], a[2]}; }
Vector3 array(const Vector& a) { return {a[0], a[1], a[2]}; }

/** A camera, as what can be interpolated: right, top and back of the view as the columns of a rotation. */
struct Pose {
    Vector look_at;
    double log_distance = 0, log_slope = 0, log_height = 0;
    Quaterniond orientation;
};

/** Of the full angle in degrees: what the picture's height goes with. */
double slope_of(double field_of_view) { return std::tan(field_of_view * std::numbers::pi / 360); }

Pose pose_of(const Camera& camera) {
    const Vector away = vector(camera.eye) - vector(camera.look_at);
    Eigen::Matrix3d axes;
    axes.col(2) = away.normalized();
    axes.col(0) = vector(camera.up).cross(axes.col(2)).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return {vector(camera.look_at), std::log(away.norm()), std::log(slope_of(camera.field_of_view)), std::log(camera.height),
            Quaterniond(axes)};
}

void apply(const Pose& pose, Camera& camera) {
    const Eigen::Matrix3d axes = pose.orientation.toRotationMatrix();
    camera.look_at = array(pose.look_at);
    camera.eye = array(pose.look_at + std::exp(pose.log_distance) * axes.col(2));
    camera.up = array(axes.col(1));
    camera.field_of_view = std::atan(std::exp(pose.log_slope)) * 360 / std::numbers::pi;
    camera.height = std::exp(pose.log_height);
}

using Numbers = Eigen::Matrix<double, 10, 1>;

Numbers numbers_of(const Pose& pose) {
    Numbers result;
    result << pose.look_at, pose.log_distance, pose.log_slope, pose.log_height, pose.orientation.coeffs();
    return result;
}

Pose pose_of(const Numbers& numbers) {
    Pose pose{numbers.head<3>(), numbers[3], numbers[4], numbers[5], Quaterniond(Eigen::Vector4d(numbers.tail<4>()))};
    pose.orientation.normalize();
    return pose;
}

/** Slope at a key: between its neighbours, one-sided at the ends. */
Numbers tangent(const std::vector<Numbers>& keys, const std::vector<double>& times, std::size_t i) {
    const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, keys.size() - 1);
    return (keys[after] - keys[before]) / (times[after] - times[before]);
}

Numbers interpolate(const std::vector<Numbers>& keys, const std::vector<double>& times, double time) {
    const auto next = std::upper_bound(times.begin() + 1, times.end() - 1, time);
    const auto i = static_cast<std::size_t>(next - times.begin()) - 1;
    const double length = times[i + 1] - times[i], s = (time - times[i]) / length, t = 1 - s;
    // The cubic Hermite basis.
    return t * t * (1 + 2 * s) * keys[i] + s * s * (1 + 2 * t) * keys[i + 1] + s * t * t * length * tangent(keys, times, i) -
           s * s * t * length * tangent(keys, times, i + 1);
}

Camera camera_of(const KeyFrame& key, const Camera& camera) {
    Camera result = camera;
    result.eye = key.eye.value_or(camera.eye);
    result.look_at = key.look_at.value_or(camera.look_at);
    result.up = key.up.value_or(camera.up);
    result.field_of_view = key.field_of_view.value_or(camera.field_of_view);
    result.height = key.height.value_or(camera.height);
    const Vector away = vector(result.eye) - vector(result.look_at);
    if (!(away.norm() > 0)) {
        throw Error("animation", "of key frame " + std::to_string(key.frame) + " eye and look_at are the same point");
    }
    if (!(away.normalized().cross(vector(result.up)).norm() > 1e-9 * vector(result.up).norm())) {
        throw Error("animation", "of key frame " + std::to_string(key.frame) + " up has length zero or points along the view");
    }
    return result;
}

std::vector<Camera> through_keys(const std::vector<KeyFrame>& key_frames, const Camera& camera) {
    std::vector<Numbers> keys;
    std::vector<double> times;
    for (const KeyFrame& key : key_frames) {
        Numbers numbers = numbers_of(pose_of(camera_of(key, camera)));
        // A quaternion and its negative are one orientation: the nearer one is the shorter way.
        if (!keys.empty() && numbers.tail<4>().dot(keys.back().tail<4>()) < 0) {
            numbers.tail<4>() *= -1;
        }
        keys.push_back(numbers);
        times.push_back(key.frame);
    }
    std::vector<Camera> path(key_frames.back().frame + 1, camera);
    for (std::size_t frame = 0; frame < path.size(); ++frame) {
        apply(pose_of(interpolate(keys, times, static_cast<double>(frame))), path[frame]);
    }
    for (const KeyFrame& key : key_frames) {
        // As they are, without the rounding on the way.
        path[key.frame] = camera_of(key, camera);
    }
    return path;
}

std::vector<Camera> around(const Turntable& turntable, const Camera& camera) {
    const Vector axis = vector(turntable.axis.value_or(camera.up));
    if (!(axis.norm() > 0)) {
        throw Error("animation", "the axis of the turntable has length zero");
    }
    const Vector middle = vector(camera.look_at);
    std::vector<Camera> path(turntable.n_frames, camera);
    for (std::size_t frame = 1; frame < path.size(); ++frame) {
        const double angle = turntable.degrees * std::numbers::pi / 180 * static_cast<double>(frame) / turntable.n_frames;
        const Eigen::AngleAxisd turn(angle, axis.normalized());
        path[frame].eye = array(middle + turn * (vector(camera.eye) - middle));
        path[frame].up = array(turn * vector(camera.up));
    }
    return path;
}

} // namespace

std::optional<TimeStepRange> parse_time_steps(const std::string& text) {
    if (text == "all") {
        return TimeStepRange{};
    }
    std::vector<std::uint32_t> numbers;
    const char* at = text.data();
    const char* const end = text.data() + text.size();
    while (true) {
        std::uint32_t number = 0;
        const auto [after, error] = std::from_chars(at, end, number);
        if (error != std::errc() || (after != end && *after != ':')) {
            return {};
        }
        numbers.push_back(number);
        if (after == end) {
            break;
        }
        at = after + 1;
    }
    if (numbers.size() < 2 || numbers.size() > 3 || (numbers.size() == 3 && numbers[2] == 0)) {
        return {};
    }
    return TimeStepRange{numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 1};
}

std::vector<std::uint32_t> steps_of(const TimeStepRange& range, std::size_t n_steps, const std::string& place) {
    const std::int64_t first = range.first, last = range.last ? *range.last : static_cast<std::int64_t>(n_steps) - 1;
    for (const std::int64_t step : {first, last}) {
        if (step < 0 || step >= static_cast<std::int64_t>(n_steps)) {
            throw Error(place,
                        "has " + counted(n_steps, "time step") + ", counted from 0; there is no step " + std::to_string(step));
        }
    }
    std::vector<std::uint32_t> steps;
    const std::int64_t stride = first <= last ? std::int64_t{range.stride} : -std::int64_t{range.stride};
    for (std::int64_t step = first; stride > 0 ? step <= last : step >= last; step += stride) {
        steps.push_back(static_cast<std::uint32_t>(step));
    }
    return steps;
}

std::vector<Camera> camera_path(const SceneAnimation& animation, const Camera& camera) {
    if (animation.turntable) {
        return around(*animation.turntable, camera);
    }
    return animation.key_frames.empty() ? std::vector<Camera>{camera} : through_keys(animation.key_frames, camera);
}

std::vector<AnimationFrame> animation_frames(const SceneAnimation& animation, const std::vector<std::uint32_t>& steps,
                                             std::uint32_t time_step, const Camera& camera) {
    const std::vector<Camera> path = camera_path(animation, camera);
    const std::size_t n_frames = std::max({path.size(), steps.size(), std::size_t{animation.n_phases}});
    std::vector<AnimationFrame> frames;
    for (std::size_t frame = 0; frame < n_frames; ++frame) {
        frames.push_back(
            {steps.empty() ? time_step : steps[frame * steps.size() / n_frames], path[frame * path.size() / n_frames]});
        if (animation.n_phases > 0) {
            const std::size_t phase = frame * animation.n_phases / n_frames;
            frames.back().phase = 360.0 * static_cast<double>(phase) / animation.n_phases;
        }
    }
    return frames;
}

} // namespace elvis
