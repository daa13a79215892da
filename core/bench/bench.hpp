/**
 * @file bench.hpp
 * Measurements that anyone can repeat. Times are compared across machines and days in the unit U: the core-nanoseconds of one
 * order-6 hexahedron field value (343 coefficients) for a full subgroup of eight lanes, measured in the same run.
 *
 * Times of the device are processor time of this process over the number of processors, what an idle machine would show; where
 * the device is no processor, wall time.
 */
#pragma once

#include <core/bench/waves.hpp>
#include <core/render/renderer.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <functional>
#include <vector>

namespace elvis {

struct UnitResult {
    /** Nanoseconds of one processor core for eight values (of the whole device, if it is no processor). */
    double nanoseconds = 0;
    std::uint64_t n_values = 0;
};
UnitResult bench_unit(const Device& device, const PluginRegistry& registry, const BenchFolder& folder);

/**
 * What the picture shows: a plane through the volume, its boundary, or where the field is 0 (a large surface) or 1.2 (blobs);
 * the blobs, too, without leaving out elements by the range of the field.
 */
enum class BenchView { cut_plane, boundary, isosurface_large, isosurface_blobs, isosurface_blobs_unskipped };

struct SurfaceResult {
    std::uint32_t elements_a_side = 0;
    std::uint32_t order = 0;
    std::uint32_t size = 0;
    double milliseconds = 0;
    double wall_milliseconds = 0;
    double evaluations_a_pixel = 0;
    double newton_steps_a_pixel = 0;
    /** Of pixels in which something is seen. */
    double estimated_share = 0;
    double undecided_share = 0;
    RendererMemory memory;
    /** On the device over what the coefficients alone take in single precision; bytes an element for the hierarchy. */
    double field_overhead = 0;
    double geometry_overhead = 0;
    double hierarchy_bytes_an_element = 0;
};
/** Calls `report` after each scene. */
void bench_surface(const Device& device, const PluginRegistry& registry, const BenchFolder& folder, BenchView view,
                   const std::vector<std::uint32_t>& elements_a_side, const std::vector<std::uint32_t>& orders,
                   const std::vector<std::uint32_t>& sizes, const std::function<void(const SurfaceResult&)>& report);

/** All segments of all rays of the waves picture: traversal alone, no field. */
struct SegmentsResult {
    std::uint32_t elements_a_side = 0;
    std::uint32_t size = 0;
    Precision precision = Precision::float32;
    double milliseconds = 0;
    std::uint64_t n_segments = 0, n_overlaps = 0, n_failures = 0, n_breaks = 0, n_undecided = 0;
    /** Evaluations of the mapping, on the way and to find where it begins. */
    double evaluations_a_segment = 0, seek_evaluations_a_ray = 0;
};
void bench_segments(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                    const std::vector<std::uint32_t>& elements_a_side, const std::vector<std::uint32_t>& sizes,
                    const std::function<void(const SegmentsResult&)>& report);

struct HierarchyResult {
    std::uint64_t n_items = 0;
    double wall_milliseconds = 0;
    std::uint32_t depth = 0;
    /** Boxes that a query at a random point of the volume finds, on average. */
    double boxes_a_query = 0;
};
HierarchyResult bench_hierarchy(std::uint64_t n_items);

struct JacobianResult {
    std::uint64_t n_elements = 0;
    std::uint32_t geometry_order = 0;
    /** Largest random shift of a node, over the distance between nodes. */
    double disturbance = 0;
    /** Of one processor core. */
    double elements_a_second = 0;
    std::uint64_t n_negative = 0;
    std::uint64_t n_undecided = 0;
};
/** The certified check of Jacobians on hexahedra of the waves mesh; geometry order 1 or 2. */
JacobianResult bench_jacobian(std::uint64_t n_elements, std::uint32_t geometry_order, double disturbance);

} // namespace elvis
