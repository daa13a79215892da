/**
 * @file surface_fixture.hpp
 * One cut surface drawn by the program's passes alone, and the same found by brute force.
 */
#pragma once

#include <core/oracle/picture/ray.hpp>
#include <core/oracle/samples/meshes.hpp>
#include <tests/support/test_volumes.hpp>

#include <core/render/cut_surface/surface_pass.hpp>

#include <Eigen/Geometry>

#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace elvis::oracle {

/** In place of an element where the surface lies in none and that is shown. */
inline constexpr std::int64_t outside_element = -2;

/** What the passes leave, one entry a pixel; element -1 where nothing is seen. */
struct SurfacePicture {
    std::vector<double> value, depth, bending;
    std::vector<Vector> normal;
    std::vector<std::int64_t> element;
    std::vector<std::uint32_t> flags;
    FrameCounts counts;
};

/** A volume on the device with one scalar field, ready to be cut by any number of surfaces. */
class SurfaceScene {
public:
    SurfaceScene(const std::string& path, Precision precision);

    /** `beyond`: a depth a pixel, or empty. */
    SurfacePicture draw(const SurfaceSolver& solver, const CutShape& shape, const Camera& camera, std::uint32_t width,
                        std::uint32_t height, const std::vector<double>& beyond = {}, bool shows_outside = false);
    const DeviceVolume& data() const { return m_data; }
    Precision precision() const { return m_precision; }

private:
    Precision m_precision;
    RuntimeVolume m_volume;
    DeviceVolume m_data;
    std::optional<SurfacePass> m_pass;
};

/** A surface to brute force: a function that changes sign at it, in extended precision. */
using LevelFunction = std::function<long double(const LongVector&)>;
/** Distances along a ray, between two, at which it meets the surface, ascending. */
using Crossings = std::function<std::vector<double>(const Ray& ray, double from, double to)>;
using Membership = std::function<bool(const Vector&)>;

/**
 * Distances along a ray, between two, at which the function changes sign: `n` samples, and where three neighbouring ones show
 * an extremum without a change of sign, a search for it.
 */
std::vector<double> crossings(const Ray& ray, const LevelFunction& function, double from, double to, int n);

/** What holds over a picture. */
struct SurfaceComparison {
    std::size_t hits = 0, undecided = 0, estimated = 0;
    /** Seen by one only, and not flagged. */
    std::size_t missed = 0, extra = 0;
    /** Relative to the size of the box: depth where |n.d| >= 0.05, elsewhere the distance from the surface. */
    double depth_error = 0, distance_error = 0;
    double value_error = 0, normal_error = 0;
    std::size_t worst = 0;
};

/** The box [-1,1]^3 without |x| < 0.3, in hexahedra bent by a quadratic map, with a field whose values `field_of` gives. */
VolumeData two_blocks();
bool is_in_two_blocks(const Vector& x);
double field_of(const Vector& x);

/** `gradient`: a normal of any length. Pixels flagged undecided are counted and left out. */
SurfaceComparison compare(const SurfacePicture& picture, const Camera& camera, std::uint32_t width, std::uint32_t height,
                          const Crossings& crossings_of, const std::function<Vector(const Vector&)>& gradient,
                          const Membership& is_inside);

std::string to_text(const SurfaceComparison& comparison);

/**
 * Draws a sheet that covers the picture, parallel rays along the turned x axis to (0.65, 0, 0), in both precisions: no pixel is
 * missed or undecided. `height`: of the picture; `what`: for the message.
 */
void check_no_gaps(const std::string& volume, const CutShape& shape, const Eigen::AngleAxisd& turn, std::uint32_t side,
                   double height, const std::string& what);

Camera camera_at(const Vector3& eye, double field_of_view = 40, const Vector3& look_at = {});

} // namespace elvis::oracle
