#include "ray.hpp"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace elvis::oracle {
namespace {

LongVector convert(const Vector3& v) { return {v[0], v[1], v[2]}; }

} // namespace

Ray pixel_ray(const Camera& camera, std::uint32_t width, std::uint32_t height, long double column, long double row) {
    const LongVector d = (convert(camera.look_at) - convert(camera.eye)).normalized();
    const LongVector right = d.cross(convert(camera.up)).normalized();
    const LongVector top = right.cross(d);
    const long double w = width;
    const long double h = height;
    const long double s = (2 * (column + 0.5L + camera.image_shift[0]) / w - 1) * w / h;
    const long double v = 1 - 2 * (row + 0.5L + camera.image_shift[1]) / h;
    const LongVector sideways = s * right + v * top;
    if (camera.orthographic)
        return {convert(camera.eye) + camera.height / 2.0L * sideways, d};
    const long double half_angle = camera.field_of_view / 360.0L * std::numbers::pi_v<long double>;
    return {convert(camera.eye), (d + std::tan(half_angle) * sideways).normalized()};
}

std::optional<long double> plane_distance(const Ray& ray, const CutPlane& plane) {
    const LongVector normal(plane.plane[0], plane.plane[1], plane.plane[2]);
    const long double t = -(normal.dot(ray.origin) + plane.plane[3]) / normal.dot(ray.direction);
    if (!std::isfinite(t) || t <= 0)
        return std::nullopt;
    return t;
}

} // namespace elvis::oracle
