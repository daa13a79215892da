/**
 * @file contour_lines.hpp
 * Where a function has a value on a mesh's surface.
 */
#pragma once

#include <core/extract/merged_mesh.hpp>

#include <vector>

namespace elvis {

struct ContourPoint {
    std::uint32_t element = 0;
    SurfacePoint at;
    Vector3 normal{};
};

struct ContourLine {
    double isovalue = 0;
    /** Numbers of points; a closed line has its first again as its last. */
    std::vector<std::uint32_t> points;
};

struct ContourLines {
    std::vector<ContourPoint> points;
    std::vector<ContourLine> lines;
    double length = 0;
    /** How far curves are from lines, at places between points. */
    double distance = 0;
    /** That lie neither in a rim of the mesh nor meet another line. */
    std::uint64_t n_open_ends = 0;
};

/** Points on a side of a triangle that are nearer than `distance` are one. Cells that are off by more than `most` are wanted.
 */
ContourLines contour_lines(const SurfaceSampler& sampler, CellMesh& cells, const MergedMesh& mesh,
                           const std::vector<double>& isovalues, double distance, double most);

} // namespace elvis
