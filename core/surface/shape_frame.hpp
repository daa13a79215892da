/**
 * @file shape_frame.hpp
 * A surface given by a formula, prepared for one picture: its coefficients in extended precision about a point near what is
 * seen, so that single precision loses none of the surface's position where it is looked at.
 */
#pragma once

#include <core/surface/shape.hpp>

#include <vector>

namespace elvis {

/** What the device's solver is called, and the numbers it reads: shaders/cut_surface/surface_NAME.glsl describes the rows. */
struct ShapeFrame {
    std::string solver;
    std::vector<std::array<double, 4>> rows;
};

/** Name of the solver that shape_frame() gives a shape. */
std::string shape_solver(const CutShape& shape);

/** `reference`: what rays are relative to (CutPlaneGeometry). */
ShapeFrame shape_frame(const CutShape& shape, const Vector3& reference);

/** A box that holds all of the surface: min x y z, max x y z; infinite where the surface is. */
std::array<double, 6> shape_bounds(const CutShape& shape);

/** Middle of a finite shape's box, exact in single precision: what the coordinates of meshes are relative to on the device. */
Vector3 shape_middle(const CutShape& shape);

} // namespace elvis
