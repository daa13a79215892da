/**
 * @file nearest.hpp
 * Points of the true surface, and distances from flat pieces.
 */
#pragma once

#include <core/base/vector3.hpp>
#include <core/extract/surface_sampler.hpp>

#include <elvis/element.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace elvis {

using Triangle3 = std::array<Vector3, 3>;

double distance_to_segment(const Vector3& point, const Vector3& from, const Vector3& to);
double distance_to_triangle(const Vector3& point, const Triangle3& triangle);
/** From the plane that holds it; from its longest side, if it has no area. */
double distance_to_plane(const Vector3& point, const Triangle3& triangle);

/** Where the linear model at a point has the surface: the nearest place. */
Vector3 predicted_surface(const SurfacePoint& point);

/** An element, and the face of it that the surface is, if it is one. */
struct SurfaceElement {
    std::uint64_t element = 0;
    elvis_shape shape = ELVIS_SHAPE_HEXAHEDRON;
    Vector3 face_normal{};
};

/** From where to go to the surface. */
struct NearestQuery {
    Vector3 target{}, xi{};
};
/** Points of the surface in the element that are nearest to targets, but for the step that is left after a few. */
std::vector<SurfacePoint> nearest_on_surface(const SurfaceSampler& sampler, const SurfaceElement& element,
                                             std::span<const NearestQuery> queries);

/** A curve on the surface, or a point of such a curve. */
struct CurveQuery {
    Vector3 xi{};
    /** Where the contour function is this. */
    std::optional<double> contour;
    /** In the plane of this normal in reference coordinates, through xi. */
    std::optional<Vector3> face;
};
/** Points of curves near where the queries begin, by Newton's method. */
std::vector<SurfacePoint> points_of_curves(const SurfaceSampler& sampler, const SurfaceElement& element,
                                           std::span<const CurveQuery> queries);

} // namespace elvis
