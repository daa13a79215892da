/**
 * @file patch_mesh.hpp
 * Surfaces made of bicubic Bezier patches, from the text files (.bpt) that the Utah teapot is passed around in.
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace elvis {

/** Control point i, j (of u, v) is points[4 i + j]. */
struct BezierPatch {
    std::array<Vector3, 16> points{};

    /** u and v in [0, 1]. */
    Vector3 at(double u, double v) const;
    /** The part over [u0, u0 + h] x [v0, v0 + h], by blossoming. */
    BezierPatch part(double u0, double v0, double h) const;
};

struct PatchMesh {
    std::string path;
    std::vector<BezierPatch> patches;

    /** Of the control points, which hold the surface: min x y z, max x y z. */
    std::array<double, 6> bounds() const;
};

/**
 * Reads a file: the number of patches; then for each "3 3" (its orders) and 16 points of three numbers, v running first. An
 * Error names file, line and cause.
 */
PatchMesh read_patch_mesh(const std::string& path);
PatchMesh read_bpt(const std::string& path, std::string_view text);

} // namespace elvis
