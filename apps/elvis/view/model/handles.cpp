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

constexpr const char* move_text = "Drag: move it";
constexpr const char* move_end_text = "Drag: move this end";
constexpr const char* grow_text = "Drag: change the radius";

/** What can be dragged of a surface; nothing of most kinds. */
struct HandlesOf {
    using Handles = std::vector<Handle>;
    const VolumeFacts& volume;

    Handles operator()(const CutPlane& plane) const {
        const Vector3 anchor = anchor_of(plane, volume);
        const Vector3 normal = normal_of(plane);
        const Vector3 tip = plus(anchor, scaled(normal, arrow_length * volume.diagonal()));
        return {{Handle::Kind::along, anchor, normal, std::nullopt, "Drag: move the plane along its normal", "move"},
                {Handle::Kind::free, tip, {}, anchor, "Drag: turn the plane", "turn"}};
    }
    Handles operator()(const CutShape& shape) const { return std::visit(*this, shape); }
    Handles operator()(const Sphere& sphere) const {
        const Vector3 out = {1, 0, 0};
        return {
            {Handle::Kind::free, sphere.center, {}, std::nullopt, move_text, "move"},
            {Handle::Kind::along, plus(sphere.center, scaled(out, sphere.radius)), out, sphere.center, grow_text, "radius"}};
    }
    Handles operator()(const Torus& torus) const {
        const Vector3 out = across(torus.axis);
        return {
            {Handle::Kind::free, torus.center, {}, std::nullopt, move_text, "move"},
            {Handle::Kind::along, plus(torus.center, scaled(out, torus.major_radius)), out, torus.center, grow_text, "radius"}};
    }
    Handles operator()(const Cylinder& cylinder) const {
        const Vector3 out = across(minus(cylinder.to, cylinder.from));
        Handles handles = of_ends(cylinder.from, cylinder.to);
        handles.push_back(
            {Handle::Kind::along, plus(cylinder.from, scaled(out, cylinder.radius)), out, cylinder.from, grow_text, "radius"});
        return handles;
    }
    Handles operator()(const Cone& cone) const { return of_ends(cone.from, cone.to); }
    Handles operator()(const Quadric&) const { return {}; }
    Handles operator()(const ImplicitSurface&) const { return {}; }
    Handles operator()(const MeshSurface&) const { return {}; }
    Handles operator()(const BezierSurface&) const { return {}; }
    Handles operator()(const TubeSurface&) const { return {}; }
    Handles operator()(const ArrowSurface&) const { return {}; }
    Handles operator()(const FaceGeometry&) const { return {}; }
    Handles operator()(const WireFrame&) const { return {}; }
    Handles operator()(const Isosurfaces&) const { return {}; }

    static Handles of_ends(const Vector3& from, const Vector3& to) {
        return {{Handle::Kind::free, from, {}, std::nullopt, move_end_text, "from"},
                {Handle::Kind::free, to, {}, from, move_end_text, "to"}};
    }
};

std::vector<Handle> handles_of_seeds(const std::vector<Vector3>& seeds) {
    std::vector<Handle> handles;
    for (const Vector3& seed : seeds) {
        handles.push_back({Handle::Kind::free, seed, {}, std::nullopt, "Drag: move the seed of a line", "seed"});
    }
    return handles;
}

/** Drags one of these handles to a position. */
struct MovedHandle {
    const VolumeFacts& volume;
    std::size_t handle;
    const Vector3& position;

    void operator()(CutPlane& plane) const {
        if (handle == 0) {
            plane.plane[3] -= side(plane, position) * length({plane.plane[0], plane.plane[1], plane.plane[2]});
            return;
        }
        const Vector3 anchor = anchor_of(plane, volume);
        const Vector3 normal = minus(position, anchor);
        if (length(normal) > 1e-9 * volume.diagonal()) {
            plane = plane_through(anchor, unit(normal));
        }
    }
    void operator()(CutShape& shape) const { std::visit(*this, shape); }
    void operator()(Sphere& sphere) const { move_round(sphere.center, sphere.radius); }
    void operator()(Torus& torus) const { move_round(torus.center, torus.major_radius); }
    void operator()(Cylinder& cylinder) const {
        if (handle == 2) {
            cylinder.radius = radius_from(cylinder.from);
        } else {
            move_end(cylinder.from, cylinder.to);
        }
    }
    void operator()(Cone& cone) const { move_end(cone.from, cone.to); }
    /** Kinds without handles. */
    void operator()(const Quadric&) const {}
    void operator()(const ImplicitSurface&) const {}
    void operator()(const MeshSurface&) const {}
    void operator()(const BezierSurface&) const {}
    void operator()(const TubeSurface&) const {}
    void operator()(const ArrowSurface&) const {}
    void operator()(const FaceGeometry&) const {}
    void operator()(const WireFrame&) const {}
    void operator()(const Isosurfaces&) const {}

    double radius_from(const Vector3& centre) const {
        constexpr double least = 1e-9;
        return std::max(length(minus(position, centre)), least);
    }
    void move_round(Vector3& centre, double& radius) const {
        if (handle == 0) {
            centre = position;
        } else {
            radius = radius_from(centre);
        }
    }
    /** The two stay apart. */
    void move_end(Vector3& from, Vector3& to) const {
        if (position != (handle == 0 ? to : from)) {
            (handle == 0 ? from : to) = position;
        }
    }
};

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
    const SceneSurface& surface = scene.surfaces[item.index];
    if (surface.streamlines) {
        return handles_of_seeds(surface.streamlines->seeds);
    }
    return std::visit(HandlesOf{volume}, surface.geometry);
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
    SceneSurface& surface = result.surfaces[item.index];
    if (surface.streamlines) {
        surface.streamlines->seeds[handle] = position;
        return result;
    }
    std::visit(MovedHandle{volume, handle, position}, surface.geometry);
    return result;
}

} // namespace elvis::view
