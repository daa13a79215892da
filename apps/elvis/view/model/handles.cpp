#include "handles.hpp"

#include <algorithm>
#include <cmath>

namespace elvis::view {

namespace {

constexpr double arrow_length = 0.15; ///< of the volume's diagonal

Vector3 normal_of(const CutPlane& plane) { return unit({plane.plane[0], plane.plane[1], plane.plane[2]}); }

double side(const CutPlane& plane, const Vector3& point) {
    const Vector3 normal = {plane.plane[0], plane.plane[1], plane.plane[2]};
    return (dot(normal, point) + plane.plane[3]) / length(normal);
}

/** The point of the plane nearest to the middle of the volume. */
Vector3 anchor_of(const CutPlane& plane, const VolumeFacts& volume) {
    const auto& b = volume.bounds;
    const Vector3 middle = {0.5 * (b[0] + b[3]), 0.5 * (b[1] + b[4]), 0.5 * (b[2] + b[5])};
    return minus(middle, scaled(normal_of(plane), side(plane, middle)));
}

CutPlane plane_through(const Vector3& point, const Vector3& normal) {
    return {{normal[0], normal[1], normal[2], -dot(normal, point)}};
}

/** A unit vector across another one. */
Vector3 across(const Vector3& a) {
    const Vector3 other = std::abs(a[0]) < 0.5 * length(a) ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
    return unit(cross(a, other));
}

std::vector<Handle> handles_of_plane(const CutPlane& plane, const VolumeFacts& volume) {
    const Vector3 anchor = anchor_of(plane, volume);
    const Vector3 normal = normal_of(plane);
    const Vector3 tip = plus(anchor, scaled(normal, arrow_length * volume.diagonal()));
    return {{Handle::Kind::along, anchor, normal, std::nullopt, "Drag: move the plane along its normal", "move"},
            {Handle::Kind::free, tip, {}, anchor, "Drag: turn the plane", "turn"}};
}

std::vector<Handle> handles_of_shape(const CutShape& shape) {
    const char* move = "Drag: move it";
    const char* grow = "Drag: change the radius";
    if (const auto* sphere = std::get_if<Sphere>(&shape)) {
        const Vector3 out = {1, 0, 0};
        return {{Handle::Kind::free, sphere->center, {}, std::nullopt, move, "move"},
                {Handle::Kind::along, plus(sphere->center, scaled(out, sphere->radius)), out, sphere->center, grow, "radius"}};
    }
    if (const auto* torus = std::get_if<Torus>(&shape)) {
        const Vector3 out = across(torus->axis);
        return {
            {Handle::Kind::free, torus->center, {}, std::nullopt, move, "move"},
            {Handle::Kind::along, plus(torus->center, scaled(out, torus->major_radius)), out, torus->center, grow, "radius"}};
    }
    if (const auto* cylinder = std::get_if<Cylinder>(&shape)) {
        const Vector3 out = across(minus(cylinder->to, cylinder->from));
        return {
            {Handle::Kind::free, cylinder->from, {}, std::nullopt, "Drag: move this end", "from"},
            {Handle::Kind::free, cylinder->to, {}, cylinder->from, "Drag: move this end", "to"},
            {Handle::Kind::along, plus(cylinder->from, scaled(out, cylinder->radius)), out, cylinder->from, grow, "radius"}};
    }
    if (const auto* cone = std::get_if<Cone>(&shape)) {
        return {{Handle::Kind::free, cone->from, {}, std::nullopt, "Drag: move this end", "from"},
                {Handle::Kind::free, cone->to, {}, cone->from, "Drag: move this end", "to"}};
    }
    return {};
}

void move_shape(CutShape& shape, std::size_t handle, const Vector3& position) {
    constexpr double least = 1e-9;
    if (auto* sphere = std::get_if<Sphere>(&shape)) {
        if (handle == 0) {
            sphere->center = position;
        } else {
            sphere->radius = std::max(length(minus(position, sphere->center)), least);
        }
    } else if (auto* torus = std::get_if<Torus>(&shape)) {
        if (handle == 0) {
            torus->center = position;
        } else {
            torus->major_radius = std::max(length(minus(position, torus->center)), least);
        }
    } else if (auto* cylinder = std::get_if<Cylinder>(&shape)) {
        if (handle == 2) {
            cylinder->radius = std::max(length(minus(position, cylinder->from)), least);
        } else if (position != (handle == 0 ? cylinder->to : cylinder->from)) {
            (handle == 0 ? cylinder->from : cylinder->to) = position;
        }
    } else if (auto* cone = std::get_if<Cone>(&shape)) {
        if (position != (handle == 0 ? cone->to : cone->from)) {
            (handle == 0 ? cone->from : cone->to) = position;
        }
    }
}

} // namespace

std::vector<Handle> handles_of(const Scene& scene, const ItemId& item, const VolumeFacts& volume) {
    if (item.kind == ItemKind::light) {
        const Light& light = scene.lighting->lights[item.index];
        if (light.type == Light::Type::point) {
            return {{Handle::Kind::free, light.vector, {}, std::nullopt, "Drag: move the light", "move"}};
        }
        return {};
    }
    if (item.kind != ItemKind::surface || !scene.surfaces[item.index].is_shown) {
        return {};
    }
    const SurfaceGeometry& geometry = scene.surfaces[item.index].geometry;
    if (const auto* plane = std::get_if<CutPlane>(&geometry)) {
        return handles_of_plane(*plane, volume);
    }
    if (const auto* shape = std::get_if<CutShape>(&geometry)) {
        return handles_of_shape(*shape);
    }
    return {};
}

Vector3 dragged_to(const Handle& handle, const Camera& camera, const PictureSize& size, const PicturePoint& from,
                   const PicturePoint& to) {
    if (handle.kind == Handle::Kind::free) {
        const double pixel = pixel_length(camera, size, handle.position);
        const ViewAxes axes = axes_of(camera);
        return plus(handle.position,
                    plus(scaled(axes.right, (to[0] - from[0]) * pixel), scaled(axes.top, -(to[1] - from[1]) * pixel)));
    }
    // The point of the line that is nearest to the ray, before and after.
    const auto along = [&](const PicturePoint& place) {
        const Ray ray = ray_through(camera, size, place);
        const double b = dot(handle.direction, ray.direction);
        const Vector3 between = minus(ray.origin, handle.position);
        // Seen from its end, a line is too short to be dragged along.
        constexpr double least = 1e-3;
        return (dot(between, handle.direction) - b * dot(between, ray.direction)) / std::max(1 - b * b, least);
    };
    return plus(handle.position, scaled(handle.direction, along(to) - along(from)));
}

Scene with_moved_handle(const Scene& scene, const ItemId& item, const VolumeFacts& volume, std::size_t handle,
                        const Vector3& position) {
    Scene result = scene;
    if (item.kind == ItemKind::light) {
        result.lighting->lights[item.index].vector = position;
        return result;
    }
    SurfaceGeometry& geometry = result.surfaces[item.index].geometry;
    if (auto* plane = std::get_if<CutPlane>(&geometry)) {
        if (handle == 0) {
            plane->plane[3] -= side(*plane, position) * length({plane->plane[0], plane->plane[1], plane->plane[2]});
        } else {
            const Vector3 anchor = anchor_of(*plane, volume);
            const Vector3 normal = minus(position, anchor);
            if (length(normal) > 1e-9 * volume.diagonal()) {
                *plane = plane_through(anchor, unit(normal));
            }
        }
    } else if (auto* shape = std::get_if<CutShape>(&geometry)) {
        move_shape(*shape, handle, position);
    }
    return result;
}

} // namespace elvis::view
