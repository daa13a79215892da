/**
 * @file scalar.hpp
 * A number at every point of every element: of a field, or derived from it.
 */
#pragma once

#include <core/oracle/element/volume.hpp>

#include <functional>

namespace elvis::oracle {

/** Value, and the gradient with respect to xi if wanted. */
using Scalar = std::function<double(const Volume& volume, std::size_t element, const Vector& xi, Vector* gradient)>;

/** A component of the volume's field, or its magnitude for -1. */
Scalar scalar_of_field(const Volume& volume, std::int32_t component);

/** Gradients by central differences of order six in xi, good to about 1e-11 for fields of moderate order. */
Scalar with_differences(std::function<double(const Volume& volume, std::size_t element, const Vector& xi)> value);

} // namespace elvis::oracle
