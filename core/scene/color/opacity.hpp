/**
 * @file opacity.hpp
 * Density of a volume from opacity over a unit of length, as ParaView and VTK describe volumes.
 */
#pragma once

#include <core/render/volume/transfer_function.hpp>

#include <vector>

namespace elvis {

/** A point of VTK's vtkPiecewiseFunction, with how the curve goes on to the next point. */
struct OpacityPoint {
    double value = 0;
    /** What part of the light a unit distance takes away, in [0, 1]. */
    double opacity = 0;
    /** Where between this point and the next the mean of both is reached, in [0, 1]. */
    double midpoint = 0.5;
    /** From 0, linear on both sides of the midpoint, to 1, a step there. */
    double sharpness = 0;
};

/** Opacity at part `t` in [0, 1] of the way from a point to the next. */
double opacity_between(const OpacityPoint& from, const OpacityPoint& to, double t);

/** -ln(1 - min(opacity, 1 - 1e-6)) / unit_distance: the density that has this opacity over the unit distance. */
double density_of(double opacity, double unit_distance);

/**
 * Density for opacity with points in ascending order: points enough that straight lines between them are within 1e-4 of the
 * largest density of the curve.
 */
std::vector<TransferFunction::DensityPoint> density_from_opacity(const std::vector<OpacityPoint>& points, double unit_distance);

} // namespace elvis
