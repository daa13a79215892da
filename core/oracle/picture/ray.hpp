/**
 * @file ray.hpp
 * The ray of a pixel and where it meets a plane, from the camera formulas of the scene file, in extended precision.
 */
#pragma once

#include <core/render/frame.hpp>

#include <Eigen/Core>

#include <array>
#include <optional>

namespace elvis::oracle {

using LongVector = Eigen::Matrix<long double, 3, 1>;

inline Eigen::Vector3d vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

struct Ray {
    LongVector origin;
    /** Of unit length. */
    LongVector direction;
};

/** Row 0 is the top one; whole numbers are the middles of pixels. */
Ray pixel_ray(const Camera& camera, std::uint32_t width, std::uint32_t height, long double column, long double row);

/** Distance from the ray's origin, > 0, or nothing. */
std::optional<long double> plane_distance(const Ray& ray, const CutPlane& plane);

} // namespace elvis::oracle
