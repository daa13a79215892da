#include <core/base/float_rounding.hpp>
#include <core/render/cut_plane_geometry.hpp>

#include <cmath>
#include <numbers>

namespace elvis {

namespace {

Vector3 plus(const Vector3& a, const Vector3& b, double factor = 1) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector3 scaled(const Vector3& a, double factor) { return {factor * a[0], factor * a[1], factor * a[2]}; }
Vector3 unit(const Vector3& a) { return scaled(a, 1 / std::sqrt(dot(a, a))); }
Vector3 cross(const Vector3& a, const Vector3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::array<double, 4> row(const Vector3& xyz, double w) { return {xyz[0], xyz[1], xyz[2], w}; }

} // namespace

CutPlaneGeometry cut_plane_geometry(const CutPlane& plane, const Camera& camera, std::uint32_t width, std::uint32_t height,
                                    const std::array<double, 3>& centre) {
    const Vector3 axis = unit(plus(camera.look_at, camera.eye, -1));
    const Vector3 right = unit(cross(axis, camera.up));
    const Vector3 top = cross(right, axis);
    const Vector3 given = {plane.plane[0], plane.plane[1], plane.plane[2]};
    const double size = std::sqrt(dot(given, given));
    const Vector3 normal = scaled(given, 1 / size);
    const double offset = plane.plane[3] / size;

    // Distance of the reference point along the view: where the axis meets the plane, if that is near where the user looks;
    // else there.
    const double to_look_at = dot(plus(camera.look_at, camera.eye, -1), axis);
    const double slope = dot(normal, axis);
    const double to_plane = slope != 0 ? -(dot(normal, camera.eye) + offset) / slope : 0;
    const double distance = to_plane > 0.1 * to_look_at && to_plane < 10 * to_look_at ? to_plane : to_look_at;
    Vector3 reference = plus(camera.eye, axis, distance);
    for (double& coordinate : reference) {
        coordinate = exact_in_float(coordinate);
    }

    // Picture coordinates s and v (both over half the height) as functions of column and row.
    const double step = 2.0 / height;
    const double s0 = (2 * (0.5 + camera.image_shift[0]) / width - 1) * width / height;
    const double v0 = 1 - 2 * (0.5 + camera.image_shift[1]) / height;
    const double spread = camera.orthographic ? 0 : std::tan(0.5 * camera.field_of_view * std::numbers::pi / 180);
    const double half = camera.orthographic ? 0.5 * camera.height : 0;

    const Vector3 direction0 = plus(plus(axis, right, spread * s0), top, spread * v0);
    const Vector3 direction_column = scaled(right, spread * step);
    const Vector3 direction_row = scaled(top, -spread * step);
    // Base: the point of the ray at `distance` along the axis, relative to the reference point.
    const Vector3 eye_to_reference = plus(camera.eye, reference, -1);
    const double reach = camera.orthographic ? half : distance * spread;
    const Vector3 base0 = plus(plus(plus(eye_to_reference, axis, distance), right, reach * s0), top, reach * v0);
    const Vector3 base_column = scaled(right, reach * step);
    const Vector3 base_row = scaled(top, -reach * step);
    const double level = dot(normal, reference) + offset;

    CutPlaneGeometry geometry;
    geometry.is_flipped = camera.orthographic ? slope > 0 : dot(normal, camera.eye) + offset < 0;
    geometry.normal = geometry.is_flipped ? scaled(normal, -1) : normal;
    geometry.rows = {row(base0, level + dot(normal, base0)),
                     row(base_column, dot(normal, base_column)),
                     row(base_row, dot(normal, base_row)),
                     row(direction0, dot(normal, direction0)),
                     row(direction_column, dot(normal, direction_column)),
                     row(direction_row, dot(normal, direction_row)),
                     row(reference, distance),
                     row(plus(reference, centre, -1), 0),
                     row(geometry.normal, 0)};
    return geometry;
}

} // namespace elvis
