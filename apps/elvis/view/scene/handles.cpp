#include "handles.hpp"

#include <core/base/bounds.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::view {

namespace {

using Plane = std::array<double, 4>;

constexpr double arrow_length = 0.15; ///< of the volume's diagonal

Vector3 normal_of(const Plane& plane) { return {plane[0], plane[1], plane[2]}; }

double side(const Plane& plane, const Vector3& point) {
    return (dot(normal_of(plane), point) + plane[3]) / length(normal_of(plane));
}

/** The point of the plane nearest to the middle of the volume. */
Vector3 anchor_of(const Plane& plane, const VolumeFacts& volume) {
    const Vector3 middle = middle_of(volume.bounds);
    return minus(middle, scaled(unit(normal_of(plane)), side(plane, middle)));
}

/** A unit vector across another one. */
Vector3 across(const Vector3& a) {
    const Vector3 other = std::abs(a[0]) < 0.5 * length(a) ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
    return unit(cross(a, other));
}

std::vector<Handle> handles_of_plane(const Plane& plane, const VolumeFacts& volume) {
    const Vector3 anchor = anchor_of(plane, volume);
    const Vector3 normal = unit(normal_of(plane));
    const Vector3 tip = plus(anchor, scaled(normal, arrow_length * volume.diagonal()));
    return {{Handle::Kind::along, anchor, normal, std::nullopt, "Drag: move the plane along its normal", "move"},
            {Handle::Kind::free, tip, {}, anchor, "Drag: turn the plane", "turn"}};
}

Handle mover(const Vector3& place, const char* help = "Drag: move it", const char* name = "move") {
    return {Handle::Kind::free, place, {}, std::nullopt, help, name};
}

Handle radius_handle(const Vector3& middle, const Vector3& out, double radius) {
    return {Handle::Kind::along, plus(middle, scaled(out, radius)), out, middle, "Drag: change the radius", "radius"};
}

/** Cylinders and cones. */
std::vector<Handle> handles_of_ends(const Json& surface) {
    constexpr const char* help = "Drag: move this end";
    const Vector3 from = surface["from"], to = surface["to"];
    std::vector<Handle> handles = {mover(from, help, "from"), {Handle::Kind::free, to, {}, from, help, "to"}};
    if (surface.contains("radius")) {
        handles.push_back(radius_handle(from, across(minus(to, from)), surface["radius"]));
    }
    return handles;
}

/** Of its place; none of most types. */
std::vector<Handle> handles_of_place(const Json& surface, const VolumeFacts& volume) {
    const std::string type = surface["type"];
    if (type == "plane") {
        return handles_of_plane(surface["plane"], volume);
    }
    if (type == "sphere") {
        return {mover(surface["center"]), radius_handle(surface["center"], {1, 0, 0}, surface["radius"])};
    }
    if (type == "torus") {
        return {mover(surface["center"]), radius_handle(surface["center"], across(surface["axis"]), surface["major_radius"])};
    }
    if (type == "cylinder" || type == "cone") {
        return handles_of_ends(surface);
    }
    std::vector<Handle> seeds;
    for (const Json& seed : part_of(surface, "seeds")) {
        seeds.push_back(mover(seed, "Drag: move the seed of a line", "seed"));
    }
    for (const Json& end : part_of(surface, "seed_line")) {
        seeds.push_back(mover(end, "Drag: move an end of the line of seeds", seeds.empty() ? "seeds from" : "seeds to"));
    }
    return seeds;
}

/** Those of its place, then two of each plane that cuts it away. */
std::vector<Handle> handles_of_surface(const Json& surface, const VolumeFacts& volume) {
    std::vector<Handle> handles = handles_of_place(surface, volume);
    for (const Json& plane : part_of(surface, "clip")) {
        const std::vector<Handle> more = handles_of_plane(plane, volume);
        handles.insert(handles.end(), more.begin(), more.end());
    }
    return handles;
}

Plane moved_plane(Plane plane, const VolumeFacts& volume, bool is_turned, const Vector3& position) {
    if (!is_turned) {
        plane[3] -= side(plane, position) * length(normal_of(plane));
    } else {
        const Vector3 anchor = anchor_of(plane, volume);
        const Vector3 normal = minus(position, anchor);
        if (length(normal) > 1e-9 * volume.diagonal()) {
            const Vector3 along = unit(normal);
            plane = {along[0], along[1], along[2], -dot(along, anchor)};
        }
    }
    return plane;
}

double radius_from(const Vector3& centre, const Vector3& position) {
    constexpr double least = 1e-9;
    return std::max(length(minus(position, centre)), least);
}

void move_surface(Json& surface, const VolumeFacts& volume, std::size_t handle, const Vector3& position) {
    const std::string type = surface["type"];
    const std::size_t n_of_place = handles_of_place(surface, volume).size();
    if (handle >= n_of_place) {
        Json& plane = surface["clip"][(handle - n_of_place) / 2];
        plane = moved_plane(plane, volume, (handle - n_of_place) % 2 == 1, position);
    } else if (type == "plane") {
        surface["plane"] = moved_plane(surface["plane"], volume, handle == 1, position);
    } else if (surface.contains("seeds")) {
        surface["seeds"][handle] = position;
    } else if (surface.contains("seed_line")) {
        if (surface["seed_line"][1 - handle] != Json(position)) {
            surface["seed_line"][handle] = position;
        }
    } else if (surface.contains("center")) {
        if (handle == 0) {
            surface["center"] = position;
        } else {
            surface[type == "torus" ? "major_radius" : "radius"] = radius_from(surface["center"], position);
        }
    } else if (handle == 2) {
        surface["radius"] = radius_from(surface["from"], position);
    } else if (surface[handle == 0 ? "to" : "from"] != Json(position)) {
        // The two ends stay apart.
        surface[handle == 0 ? "from" : "to"] = position;
    }
}

} // namespace

std::vector<Handle> handles_of(const Scene& scene, const ItemId& item, const VolumeFacts& volume) {
    if (item.kind == ItemKind::volume || !is_shown(scene, item)) {
        return {};
    }
    const Json& part = part_of(scene, item);
    if (item.kind == ItemKind::surface) {
        return handles_of_surface(part, volume);
    }
    return part["type"] == "point" ? std::vector<Handle>{mover(part["position"], "Drag: move the light")}
                                   : std::vector<Handle>{};
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
    Json& part = part_of(result, item);
    if (item.kind == ItemKind::light) {
        part["position"] = position;
    } else {
        move_surface(part, volume, handle, position);
    }
    return result;
}

} // namespace elvis::view
