/**
 * @file face_patches.hpp
 * What rays read of a face before anything is evaluated on it: squares of its parameters, small enough for the face to be
 * nearly flat there, each with a linear model and bounds of the rest (shaders/boundary/face_patch.glsl).
 */
#pragma once

#include <core/base/vector3.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace elvis {

/** Rows of four words that a patch takes. */
inline constexpr std::uint32_t patch_rows = 6;

struct FacePatches {
    /** 4 * patch_rows words a patch. */
    std::vector<std::uint32_t> records;
    /** Six numbers a patch: world coordinates. */
    std::vector<double> boxes;
};

struct FaceShape {
    int order = 1;
    bool is_triangle = false;
    /** Of T_i(u) T_j(v), in world coordinates. */
    std::span<const double> coefficients;
    /** How far the face may be from that, in each coordinate. */
    double misfit = 0;
    /** CORE_FACE_... of shaders/boundary/face_patch.glsl. */
    std::uint32_t bits = 0;
};

/**
 * Appends the patches of face number `face`. A face is divided until its normal's turn from the middle of a patch to its edge
 * and the share of the tangents that changes are less than 0.4 together, but at most `max_level` times. Bounds come from the
 * coefficients' absolute values, since |T_n| <= 1, |T_n'| <= n^2, |T_n''| <= n^2 (n^2 - 1) / 3 on [-1, 1]; they hold for the
 * face as a polynomial. `centre`: what the records' coordinates are relative to.
 */
void append_patches(const FaceShape& shape, std::uint32_t face, int max_level, const Vector3& centre, FacePatches& patches);

} // namespace elvis
