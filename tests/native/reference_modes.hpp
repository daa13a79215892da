/**
 * @file reference_modes.hpp
 * The modes once more, straight from their definitions in collapsed coordinates, without recurrences, scaling or tables.
 */
#pragma once

#include <elvis/native/space.hpp>

#include <vector>

namespace elvis::native {

/** P_n^{a,b}(z) by its explicit sum. */
long double reference_jacobi(int n, int a, int b, long double z);

/** Index (p, q, r) of a mode. */
struct ModeIndex {
    int p, q, r;
};

/** Indices in storage order. */
std::vector<ModeIndex> reference_indices(const Space& space);

/** Values of all modes at eta, in storage order. */
std::vector<long double> reference_modes(const Space& space, const Point& eta);

} // namespace elvis::native
