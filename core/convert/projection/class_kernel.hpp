/**
 * @file class_kernel.hpp
 * The matrices that turn samples of an element class into coefficients, and coefficients into values to compare.
 */
#pragma once

#include <core/convert/classes.hpp>
#include <core/convert/projection/projector.hpp>
#include <core/convert/topology/face_points.hpp>

#include <vector>

namespace elvis {

/** One projected function: field or geometry. Points are counted in the list of points it is sampled at. */
struct ProjectionKernel {
    /** First of the points that `project` takes. */
    Eigen::Index first_point = 0;
    /** modes x points */
    Eigen::MatrixXd project;
    /** check points x modes */
    Eigen::MatrixXd to_checks;
    /** Points of all faces (FacePoints) x modes; empty for the geometry. */
    Eigen::MatrixXd to_faces;
};

struct ClassKernel {
    /**
     * Fields that lie in their space, or that shall be discontinuous, are fitted over the whole element (weighted least squares
     * at Gauss points), others entity by entity. `is_continuous`: the target wanted of each field.
     */
    ClassKernel(const TargetClass& target, const std::vector<bool>& is_continuous, const FacePoints& face_points);

    ProjectionKernel geometry;
    std::vector<ProjectionKernel> fields;
    /** Where the mapping is evaluated: points of the projection, then check points. */
    PointList geometry_points;
    Eigen::Index n_geometry_checks = 0;
    /** Where the fields are sampled: points of the projections, then check points. */
    PointList field_points;
    Eigen::Index n_field_checks = 0;
};

} // namespace elvis
