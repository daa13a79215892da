/**
 * @file surface_tracer.hpp
 * Where a ray meets a surface of a scene.
 */
#pragma once

#include <core/oracle/isosurface/isosurface.hpp>

#include <elvis/element.h>

#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace elvis::oracle {

/** A point of a surface on a ray. */
struct SurfacePoint {
    double t = 0;
    /** Of the volume, or `no_element` outside of it. */
    std::size_t element = no_element;
    Vector xi = Vector::Zero();
    /** Of unit length, towards the viewer. */
    Vector normal = Vector::Zero();
    /** |normal . direction| */
    double facing = 0;

    static constexpr std::size_t no_element = std::numeric_limits<std::size_t>::max();
};

/** A scene that differs from the given one by about what rounding does. */
struct Perturbation {
    /** World length by which a plane moves along its normal. */
    double plane = 0;
    /** By which isovalues and values of transfer functions rise, over the field's range. */
    double field = 0;
};

/** For one thread. */
class SurfaceTracer {
public:
    virtual ~SurfaceTracer() = default;
    /** Points with t > near, ascending. */
    virtual std::vector<SurfacePoint> trace(const Line& line, double near, const Perturbation& perturbation) = 0;
    /** Times that the answer may lack something. */
    virtual std::uint64_t n_failures() const = 0;
};

/** All must outlive what they are given. */
std::unique_ptr<SurfaceTracer> plane_tracer(const Model& model, const CutPlane& plane);
/** Faces of elements, which neighbours may share. */
std::unique_ptr<SurfaceTracer> face_tracer(const Model& model, const SegmentFinder& finder, std::span<const elvis_face> faces);
std::unique_ptr<SurfaceTracer> isosurface_tracer(const Model& model, const Isosurface& isosurface);
/** `is_seen_outside`: points that lie in no element are points, too. */
std::unique_ptr<SurfaceTracer> shape_tracer(const Model& model, const CutShape& shape, bool is_seen_outside);
bool is_known(const CutShape& shape);

} // namespace elvis::oracle
