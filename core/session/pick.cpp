#include <core/session/pick.hpp>

#include <core/base/bounds.hpp>
#include <core/expression/expression.hpp>
#include <core/scene/frame_request.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

namespace elvis {

namespace {

/** The request for one pixel with the ray of that place. */
FrameRequest one_pixel(FrameRequest request, const PicturePoint& place) {
    // s and v of a picture of one pixel are 2 shift_x and -2 shift_y.
    const double width = request.width, height = request.height;
    request.camera.image_shift = {((place[0] + request.camera.image_shift[0]) / width - 0.5) * width / height,
                                  (place[1] + request.camera.image_shift[1]) / height - 0.5};
    request.width = request.height = 1;
    request.volume.reset(); // Light has no place.
    return request;
}

void take(const ProbedPoint& point, Picked& picked) {
    picked.position = point.position;
    picked.also = point.also;
    picked.xi = point.xi;
    if (picked.element && *picked.element != *point.element) {
        picked.also.push_back(*picked.element);
    }
    picked.element = point.element;
    picked.fields = point.fields;
    picked.order = point.expressions[0].value;
    if (point.expressions.size() > 1) {
        picked.jacobian = point.expressions[1].value;
        picked.scaled_jacobian = point.expressions[2].value;
    }
    std::sort(picked.also.begin(), picked.also.end());
}

/** What is in the element that the picked point lies in; whether there is one. */
bool probe(const Ray& ray, double diagonal, std::uint32_t time_step, const RuntimeVolume& volume, Prober& prober,
           Picked& picked) {
    ProbeWishes wishes;
    const bool is_solid = volume.dimension() == 3;
    for (const char* text : {"order", "jacobian", "scaled_jacobian"}) {
        if (!is_solid && wishes.expressions.size() == 1) {
            break; // Determinants are those of solids.
        }
        wishes.expressions.push_back(std::make_shared<const Expression>(text, volume.fields(), volume.dimension()));
    }
    // A point of the boundary may be outside by what single precision is off: then a little deeper, or less deep.
    for (const double shift : {0.0, 1e-7, -1e-7, 1e-6, -1e-6, 1e-5, -1e-5, 1e-4}) {
        const Vector3 position = ray.at(picked.depth + shift * diagonal);
        const ProbedPoint point = prober.probe(std::span(&position, 1), time_step, wishes).front();
        if (point.element) {
            take(point, picked);
            return true;
        }
    }
    return false;
}

} // namespace

Picked pick(const Scene& scene, const PicturePoint& place, const RuntimeVolume& volume, Renderer& renderer,
            const std::function<Prober&()>& prober) {
    const FrameRequest request = make_frame_request(scene, volume, renderer.ranges());
    const Ray ray =
        ray_through(request.camera, {static_cast<double>(request.width), static_cast<double>(request.height)}, place);
    const Frame frame = renderer.render(one_pixel(request, place));
    Picked picked;
    picked.is_hit = std::isfinite(frame.depth[0]);
    if (!picked.is_hit) {
        return picked;
    }
    picked.depth = frame.depth[0];
    picked.position = ray.at(picked.depth);
    picked.normal = {frame.normal[0], frame.normal[1], frame.normal[2]};
    picked.shown_value = frame.value[0];
    if (frame.element[0] >= 0) {
        picked.element = frame.element[0];
    }
    if (!probe(ray, diagonal_of(renderer.ranges().bounds()), scene.time_step, volume, prober(), picked)) {
        picked.remark = "The point lies in no element.";
    }
    return picked;
}

} // namespace elvis
