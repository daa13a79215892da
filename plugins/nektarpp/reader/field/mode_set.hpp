/**
 * @file mode_set.hpp
 * The modes of an element as a Nektar++ file describes them, and their counterpart in the native bases.
 */
#pragma once

#include "../geometry/shape_tables.hpp"

#include <functional>
#include <string>
#include <vector>

namespace nektarpp {

using elvis::native::Basis;

struct ModeSet {
    Shape shape = Shape::hexahedron;
    Basis basis = Basis::modified;
    /** NUMMODES in each direction; 1 in the third of two dimensions. */
    std::array<std::uint32_t, 3> n_modes{1, 1, 1};

    friend bool operator==(const ModeSet&, const ModeSet&) = default;
};

/** Throws std::invalid_argument with the reason if there is no such set of modes, or none that can be read. */
void check(const ModeSet& set);

/** Calls `visit` with the indices of all modes in the order of coefficients. */
void for_each_mode(const ModeSet& set, const std::function<void(const ModeIndex&)>& visit);

std::size_t n_modes(const ModeSet& set);

/** The native space that has all these modes, with the same functions. */
elvis::native::Space native_space(const ModeSet& set);

/** Positions of the modes among those of native_space. */
std::vector<std::size_t> native_modes(const ModeSet& set);
/** The same among those of a larger space of the same shape and basis. */
std::vector<std::size_t> native_modes(const ModeSet& set, const elvis::native::Space& space);

/** Whether sets of more modes in this basis hold the same functions and further ones. */
inline bool is_hierarchical(Basis basis) { return basis == Basis::modified || basis == Basis::orthogonal; }

/**
 * Order per direction of the engine's target space that contains these functions: the polynomial order in each collapsed
 * coordinate, which in pyramids is higher in the third.
 */
std::array<std::uint32_t, 3> target_order(const ModeSet& set);

/** Modified modes with n of them in every direction. */
ModeSet modified_modes(Shape shape, std::uint32_t n);

} // namespace nektarpp
