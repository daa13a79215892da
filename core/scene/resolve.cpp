#include <core/base/error.hpp>
#include <core/base/vector3.hpp>
#include <core/scene/resolve.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace elvis {

namespace {

/** Looking at a plane: its side towards +z, +y or +x, as for reading a map. */
Vector3 default_direction(std::span<const CutPlane> planes) {
    if (planes.size() != 1) {
        return unit({0.55, 0.45, 0.7});
    }
    const Vector3 normal = unit({planes[0].plane[0], planes[0].plane[1], planes[0].plane[2]});
    const auto largest =
        std::max_element(normal.begin(), normal.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
    return *largest < 0 ? scaled(normal, -1) : normal;
}

} // namespace

double fitting_distance(const std::array<double, 6>& bounds, const Vector3& look_at, const Vector3& to_eye, const Vector3& up,
                        double field_of_view, double aspect) {
    const Vector3 right = unit(cross(scaled(to_eye, -1), up));
    const Vector3 top = cross(right, scaled(to_eye, -1));
    const double slope = std::tan(0.5 * field_of_view * std::numbers::pi / 180);
    double distance = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vector3 x = {bounds[(corner & 1) ? 3 : 0], bounds[(corner & 2) ? 4 : 1], bounds[(corner & 4) ? 5 : 2]};
        const Vector3 relative = minus(x, look_at);
        const double across = std::max(std::abs(dot(relative, right)) / aspect, std::abs(dot(relative, top)));
        distance = std::max(distance, dot(relative, to_eye) + across / slope);
    }
    constexpr double margin = 1.05;
    return margin * distance;
}

Camera resolve_camera(const SceneCamera& scene, const std::array<double, 6>& bounds, std::span<const CutPlane> planes,
                      double aspect) {
    Camera camera;
    camera.orthographic = scene.orthographic.value_or(scene.height.has_value());
    camera.field_of_view = scene.field_of_view.value_or(60.0);
    camera.image_shift = scene.image_shift;
    camera.look_at = scene.look_at.value_or(
        Vector3{0.5 * (bounds[0] + bounds[3]), 0.5 * (bounds[1] + bounds[4]), 0.5 * (bounds[2] + bounds[5])});
    Vector3 to_eye = default_direction(planes);
    if (scene.eye) {
        to_eye = minus(*scene.eye, camera.look_at);
        if (!(length(to_eye) > 0)) {
            throw Error("camera", "eye and look_at are the same point");
        }
        to_eye = scaled(to_eye, 1 / length(to_eye));
    }
    const bool looks_along_y = std::abs(to_eye[1]) > 0.999;
    camera.up = scene.up.value_or(looks_along_y ? Vector3{0, 0, 1} : Vector3{0, 1, 0});
    if (!(length(cross(to_eye, camera.up)) > 1e-9 * length(camera.up))) {
        throw Error("camera", "up has length zero or points along the view");
    }
    const double distance = fitting_distance(bounds, camera.look_at, to_eye, camera.up, camera.field_of_view, aspect);
    camera.eye = scene.eye.value_or(Vector3{camera.look_at[0] + distance * to_eye[0], camera.look_at[1] + distance * to_eye[1],
                                            camera.look_at[2] + distance * to_eye[2]});
    const double slope = std::tan(0.5 * camera.field_of_view * std::numbers::pi / 180);
    camera.height = scene.height.value_or(2 * slope * length(minus(camera.eye, camera.look_at)));
    return camera;
}

CutPlane central_plane(const std::array<double, 6>& bounds) {
    std::size_t shortest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
        if (bounds[axis + 3] - bounds[axis] < bounds[shortest + 3] - bounds[shortest]) {
            shortest = axis;
        }
    }
    CutPlane plane;
    plane.plane[shortest] = 1;
    plane.plane[3] = -0.5 * (bounds[shortest] + bounds[shortest + 3]);
    return plane;
}

std::vector<CutPlane> plane_of_flat(const std::array<double, 6>& bounds) {
    double longest = 0, shortest = std::numeric_limits<double>::infinity();
    for (std::size_t axis = 0; axis < 3; ++axis) {
        longest = std::max(longest, bounds[axis + 3] - bounds[axis]);
        shortest = std::min(shortest, bounds[axis + 3] - bounds[axis]);
    }
    constexpr double flat = 1e-6;
    return shortest <= flat * longest ? std::vector<CutPlane>{central_plane(bounds)} : std::vector<CutPlane>{};
}

} // namespace elvis
