/**
 * @file pick.hpp
 * What is known of the point that a place of a picture shows.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/camera/camera_ray.hpp>
#include <core/probe/probe.hpp>
#include <core/render/renderer.hpp>
#include <core/scene/scene.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

struct Picked {
    /** Nothing was hit: then the rest is empty. */
    bool is_hit = false;
    Vector3 position{};
    double depth = 0;
    Vector3 normal{};
    /** Of the field that the surface shows, as drawn. */
    double shown_value = 0;

    /** Number of the element, as people know it; none outside of the volume. */
    std::optional<std::int64_t> element;
    Vector3 xi{};
    /** Determinant of the mapping's Jacobian, with columns of unit length, and the largest order of the first field. */
    std::optional<double> jacobian, scaled_jacobian, order;
    /** Of each field of the volume; empty where no element was found. */
    std::vector<FieldSample> fields;
    /** Other elements that contain the point. */
    std::vector<std::int64_t> also;
    /** Why something is missing. */
    std::string remark;
};

/** Asks `place` of the scene's picture. `prober` is called where something is hit. Throws Error. */
Picked pick(const Scene& scene, const PicturePoint& place, const RuntimeVolume& volume, Renderer& renderer,
            const std::function<Prober&()>& prober);

} // namespace elvis
