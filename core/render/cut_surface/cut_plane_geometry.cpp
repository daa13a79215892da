#include <core/base/float_rounding.hpp>
#include <core/render/cut_surface/cut_plane_geometry.hpp>
#include <core/vulkan/real_array.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace elvis {

namespace {

/** Of the largest coordinate: more than data that come in double precision are off
 * (shaders/cut_surface/element_candidate.glsl). */
constexpr double data_roundings = 1e-14;

double size_of(const std::array<double, 3>& point) {
    return std::max({std::abs(point[0]), std::abs(point[1]), std::abs(point[2])});
}

// More digits than double where the machine has them: what double precision draws is limited by these numbers.
namespace extended {

using Real = long double;
using Vector = std::array<Real, 3>;

Vector convert(const Vector3& a) { return {a[0], a[1], a[2]}; }
Vector plus(const Vector& a, const Vector& b, Real factor = 1) {
    return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}
Real dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector scaled(const Vector& a, Real factor) { return {factor * a[0], factor * a[1], factor * a[2]}; }
Vector unit(const Vector& a) { return scaled(a, 1 / std::sqrt(dot(a, a))); }
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::array<double, 4> row(const Vector& xyz, Real w) {
    return {static_cast<double>(xyz[0]), static_cast<double>(xyz[1]), static_cast<double>(xyz[2]), static_cast<double>(w)};
}

} // namespace extended

} // namespace

CutPlaneGeometry cut_plane_geometry(const CutPlane& plane, const Camera& camera, std::uint32_t width, std::uint32_t height,
                                    const std::array<double, 3>& centre) {
    using namespace extended;
    const Vector eye = convert(camera.eye);
    const Vector axis = unit(plus(convert(camera.look_at), eye, -1));
    const Vector right = unit(cross(axis, convert(camera.up)));
    const Vector top = cross(right, axis);
    const Vector given = {plane.plane[0], plane.plane[1], plane.plane[2]};
    const Real size = std::sqrt(dot(given, given));
    const Vector normal = scaled(given, 1 / size);
    const Real offset = plane.plane[3] / size;

    // Distance of the reference point along the view: where the axis meets the plane, if that is near where the user looks;
    // else there.
    const Real to_look_at = dot(plus(convert(camera.look_at), eye, -1), axis);
    const Real slope = dot(normal, axis);
    const Real to_plane = slope != 0 ? -(dot(normal, eye) + offset) / slope : 0;
    const Real distance = to_plane > 0.1 * to_look_at && to_plane < 10 * to_look_at ? to_plane : to_look_at;
    Vector reference = plus(eye, axis, distance);
    for (Real& coordinate : reference) {
        coordinate = exact_in_float(static_cast<double>(coordinate));
    }

    // Picture coordinates s and v (both over half the height) as functions of column and row.
    const std::uint32_t column0 = width / 2;
    const std::uint32_t row0 = height / 2;
    const Real step = 2.0L / height;
    const Real s0 = (2 * (column0 + 0.5L + camera.image_shift[0]) / width - 1) * width / height;
    const Real v0 = 1 - 2 * (row0 + 0.5L + camera.image_shift[1]) / height;
    const Real spread = camera.orthographic ? 0.0L : std::tan(camera.field_of_view * std::numbers::pi_v<Real> / 360);
    const Real half = camera.orthographic ? 0.5L * camera.height : 0.0L;

    const Vector direction0 = plus(plus(axis, right, spread * s0), top, spread * v0);
    const Vector direction_column = scaled(right, spread * step);
    const Vector direction_row = scaled(top, -spread * step);
    // Base: the point of the ray at `distance` along the axis, relative to the reference point.
    const Vector eye_to_reference = plus(eye, reference, -1);
    const Real reach = camera.orthographic ? half : distance * spread;
    const Vector base0 = plus(plus(plus(eye_to_reference, axis, distance), right, reach * s0), top, reach * v0);
    const Vector base_column = scaled(right, reach * step);
    const Vector base_row = scaled(top, -reach * step);
    const Real level = dot(normal, reference) + offset;

    CutPlaneGeometry geometry;
    geometry.is_flipped = camera.orthographic ? slope > 0 : dot(normal, eye) + offset < 0;
    const Vector towards_viewer = geometry.is_flipped ? scaled(normal, -1) : normal;
    for (std::size_t i = 0; i < 3; ++i)
        geometry.normal[i] = static_cast<double>(towards_viewer[i]);
    geometry.rows = {row(base0, level + dot(normal, base0)),
                     row(base_column, dot(normal, base_column)),
                     row(base_row, dot(normal, base_row)),
                     row(direction0, dot(normal, direction0)),
                     row(direction_column, dot(normal, direction_column)),
                     row(direction_row, dot(normal, direction_row)),
                     row(reference, distance),
                     row(plus(reference, convert(centre), -1), column0),
                     row(towards_viewer, row0),
                     {camera.near, 0,
                      static_cast<double>((geometry.is_flipped ? -1 : 1) * (dot(normal, convert(centre)) + offset)),
                      data_roundings * size_of(centre)}};
    return geometry;
}

Buffer view_buffer(const Device& device, Precision precision) {
    return {device, 4 * CutPlaneGeometry().rows.size() * real_bytes(precision), Buffer::Use::uniform};
}

void write_view(const Buffer& buffer, Precision precision, const CutPlaneGeometry& view) {
    write_reals(buffer, precision, std::span<const double>(view.rows.front().data(), 4 * view.rows.size()));
}

} // namespace elvis
