/**
 * @file reference_shape.hpp
 * Face constraints of the reference shapes, written down from elvis/element.h for the oracle alone.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <Eigen/Core>

#include <span>

namespace elvis::oracle {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

/** A point is inside when normal . xi <= offset for every face. */
struct FaceConstraint {
    Vector normal;
    double offset;
};

std::span<const FaceConstraint> face_constraints(native::Shape shape);

/** Index among them of a local face as elvis/element.h counts. */
std::size_t constraint_of_local_face(native::Shape shape, std::size_t local_face);

/** Largest normal . xi - offset; negative inside. */
double excess(native::Shape shape, const Vector& xi);

/** A point well inside: the centroid. */
Vector centre(native::Shape shape);

} // namespace elvis::oracle
