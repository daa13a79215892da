/**
 * @file point_parameters.hpp
 * What kernels are told that show points of a cut surface (shaders/cut_surface/point_parameters.glsl).
 */
#pragma once

#include <core/render/picture/layer.hpp>

#include <cstdint>

namespace elvis {

struct PointParameters {
    std::uint32_t width, height;
    /** Of the list of tiles, or of points. */
    std::uint32_t first = 0;
    std::uint32_t surface;
    std::uint32_t first_component, end_component;
    std::uint32_t lists_others;
    float value_tolerance;
    float most_error;
    std::uint32_t wants_places;

    /** `most_ray_error`: of a point, where it is not on a plane. */
    PointParameters(const LayerTarget& target, std::uint32_t surface_number, const ShownComponent& component,
                    float most_ray_error)
        : width(target.layer.width), height(target.layer.height), surface(surface_number), first_component(component.first()),
          end_component(component.end()), lists_others(component.is_discontinuous ? 1u : 0u),
          value_tolerance(component.value_tolerance), most_error(most_ray_error),
          wants_places(target.places != nullptr ? 1u : 0u) {}
};

} // namespace elvis
