#include "view.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace elvis::oracle {
namespace {

Vector3 convert(const Vector& v) { return {v[0], v[1], v[2]}; }

} // namespace

FrameRequest view_of(const Model& model, const CutPlane& plane, std::uint32_t width, std::uint32_t height, double low,
                     double high, double tilt) {
    constexpr double degree = std::numbers::pi / 180;
    FrameRequest request;
    request.width = width;
    request.height = height;
    request.background = {0.1, 0.2, 0.3, 1};

    const Vector gradient(plane.plane[0], plane.plane[1], plane.plane[2]);
    const Vector normal = gradient.normalized();
    const Vector middle = 0.5 * (model.tree.lower() + model.tree.upper());
    const Vector look_at = middle - (normal.dot(middle) + plane.plane[3] / gradient.norm()) * normal;
    Eigen::Index smallest = 0;
    normal.cwiseAbs().minCoeff(&smallest);
    const Vector up = Vector::Unit(smallest);
    const Vector aside = normal.cross(up).normalized();
    const Vector towards_eye = Eigen::AngleAxisd(tilt * degree, (aside + 0.4 * up).normalized()) * normal;

    request.camera.field_of_view = 30;
    request.camera.look_at = convert(look_at);
    request.camera.up = convert(up);
    // The plane lies within half the diagonal of its point nearest to the middle.
    const double distance = 0.5 * model.diagonal / std::sin(0.5 * request.camera.field_of_view * degree);
    request.camera.eye = convert(look_at + distance * towards_eye);

    Surface surface;
    surface.colors.points = {{low, {0.2, 0.3, 0.75}}, {0.5 * (low + high), {0.87, 0.87, 0.87}}, {high, {0.7, 0.02, 0.15}}};
    surface.colors.below = {0.2, 0.3, 0.75, 1};
    surface.colors.above = {0.7, 0.02, 0.15, 1};
    surface.colors.nan = {1, 1, 0, 1};
    surface.geometry = plane;
    request.surfaces = {surface};
    return request;
}

std::pair<double, double> value_range(const Picture& picture) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t pixel = 0; pixel < picture.value.size(); ++pixel) {
        if (picture.is_inside[pixel] == 0 || std::isnan(picture.value[pixel]))
            continue;
        low = std::min(low, picture.value[pixel]);
        high = std::max(high, picture.value[pixel]);
    }
    return {low, high};
}

} // namespace elvis::oracle
