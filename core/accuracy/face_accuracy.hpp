/**
 * @file face_accuracy.hpp
 * Pictures of a volume's boundary against the surface itself.
 */
#pragma once

#include <core/oracle/boundary/boundary.hpp>

#include <core/plugin_host/runtime_volume.hpp>
#include <core/vulkan/device.hpp>

namespace elvis::oracle {

struct FaceAccuracy {
    std::size_t n_pixels = 0, n_hits = 0;
    /** Of hits with |n.d| >= 0.05: error of the depth over the size of the boundary's box. */
    double depth_error = 0;
    /** Of the others: distance from the surface over that from the eye. */
    double grazing_error = 0;
    /** Nothing drawn where the surface is, or the other way round; at silhouettes that rays touch within rounding apart. */
    std::size_t n_missed = 0, n_invented = 0, n_touching = 0;
    std::size_t n_flagged = 0;
    std::uint64_t n_careful = 0;
    /** Rays through points of edges and through vertices: nothing drawn, or something behind the point. */
    std::size_t n_edge_rays = 0, n_leaks = 0;
    double leak_depth_error = 0;
};

/**
 * A picture of size^2 pixels from a fixed direction, of which `n_pixels` chosen by chance are compared (all if there are no
 * more), and as many pictures of one pixel as there are rays through points of edges.
 */
FaceAccuracy measure_faces(const Device& device, const RuntimeVolume& volume, const Boundary& boundary, Precision precision,
                           std::uint32_t size, std::size_t n_pixels, std::size_t n_edge_rays);

/** All faces of a volume. */
std::vector<elvis_face> faces_of(const RuntimeVolume& volume);

} // namespace elvis::oracle
