/**
 * @file reference_shape.hpp
 * Where a reference point lies with respect to its shape (elvis/element.h), on the CPU.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <elvis/element.h>

#include <array>

namespace elvis {

/** By how much a point is beyond each of at most six faces, in no particular order; -infinity for those that are not there. */
std::array<double, 6> face_excesses(elvis_shape shape, const Vector3& xi);

/** Largest violation of a face constraint; <= 0 in the closed shape. Two-dimensional shapes have no third coordinate. */
double reference_excess(elvis_shape shape, const Vector3& xi);

/** A point of the shape near xi; xi itself if it lies in the shape. Three-dimensional shapes only, as below. */
Vector3 project_into_shape(elvis_shape shape, const Vector3& xi);

Vector3 reference_centroid(elvis_shape shape);

} // namespace elvis
