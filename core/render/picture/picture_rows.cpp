#include <core/base/vector3.hpp>
#include <core/render/picture/picture_rows.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace elvis {

PixelRows rows_of_box(const std::array<double, 6>& box, const Camera& camera, std::uint32_t height, double margin) {
    const Vector3 axis = unit(minus(camera.look_at, camera.eye)), right = unit(cross(axis, camera.up)),
                  top = cross(right, axis);
    const double spread = std::tan(camera.field_of_view * std::numbers::pi / 360);
    double first = std::numeric_limits<double>::infinity(), last = -first;
    bool is_in_front = true;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vector3 point = {box[(corner & 1u) != 0 ? 3 : 0], box[(corner & 2u) != 0 ? 4 : 1],
                               box[(corner & 4u) != 0 ? 5 : 2]};
        const Vector3 from_eye = minus(point, camera.eye);
        const double distance = dot(from_eye, axis), up = dot(from_eye, top);
        // At less than that, rounding of the quotient may count.
        is_in_front = is_in_front && (camera.orthographic || distance > 1e-6 * length(from_eye));
        const double v = up / (camera.orthographic ? 0.5 * camera.height : distance * spread);
        // As in cut_plane_geometry().
        const double row = 0.5 * height * (1 - v) - 0.5 - camera.image_shift[1];
        first = std::min(first, row);
        last = std::max(last, row);
    }
    // Also if any of that is no number.
    if (!(is_in_front && std::isfinite(first) && std::isfinite(last))) {
        return {0, height};
    }
    const double end = std::clamp(std::ceil(last + margin) + 1, 0.0, static_cast<double>(height));
    return {static_cast<std::uint32_t>(std::clamp(std::floor(first - margin), 0.0, end)), static_cast<std::uint32_t>(end)};
}

} // namespace elvis
