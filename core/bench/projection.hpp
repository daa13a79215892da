/**
 * @file projection.hpp
 * What the degree of the polynomials does to isosurfaces that are drawn by projection (Nelson & Kirby 2006): each picture
 * against the converged one, in double precision.
 */
#pragma once

#include <core/bench/waves.hpp>
#include <core/render/renderer.hpp>
#include <core/vulkan/device.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace elvis {

struct ProjectionOptions {
    /** A native volume; the waves if empty. */
    std::string volume;
    /** Of the waves. */
    std::uint32_t elements_a_side = 8, order = 6;
    /** Of the first field; the middle of its range if absent. */
    std::optional<double> isovalue;
    std::uint32_t size = 256;
};

struct ProjectionRow {
    IsosurfaceMethod method = IsosurfaceMethod::bernstein;
    /** 0: as it takes. */
    std::uint32_t degree = 0;
    /** Over all polynomials along rays. */
    double mean_degree = 0;
    double evaluations_a_segment = 0;
    std::uint64_t n_segments = 0, n_verified = 0, n_certified = 0, n_projected_pixels = 0;
    std::uint64_t n_hits = 0;
    /** Pixels in which only one of the pictures shows something, or they show points apart by a hundredth of the diagonal. */
    std::uint64_t n_missing = 0, n_other = 0;
    std::uint64_t n_undecided = 0;
    /** In the others: of depth over the volume's diagonal, and |difference| of the unit normals. */
    double mean_depth_error = 0, largest_depth_error = 0, mean_normal_error = 0, largest_normal_error = 0;
    double milliseconds = 0;
};

/** Degrees 2 to 13, and adaptive ones with each method. Calls `report` after each picture. */
std::vector<ProjectionRow> bench_projection(const Device& device, const PluginRegistry& registry, const BenchFolder& folder,
                                            const ProjectionOptions& options,
                                            const std::function<void(const ProjectionRow&)>& report);

/** For people and tables. */
const char* name_of(IsosurfaceMethod method);

/** projection.csv and the plots, in a folder that is made if it does not exist. */
void write_projection(const std::filesystem::path& folder, const std::vector<ProjectionRow>& rows);

} // namespace elvis
