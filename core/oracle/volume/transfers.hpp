/**
 * @file transfers.hpp
 * Transfer functions to compare volume rendering with.
 */
#pragma once

#include <core/render/volume/transfer_function.hpp>

#include <cstdint>
#include <string>

namespace elvis::oracle {

/**
 * Three peaks of density, shaped as tents, for the field x^2 + y^2 + z^2 in [-1,1] x [-1,1] x [-2,4]: at 1, 4 and 9, and empty
 * between. `width`: of their feet, over the field's range of 18. A ray straight through all of them keeps about a quarter of
 * the light behind.
 */
TransferFunction sphere_peaks(double width);

struct RandomTransfer {
    TransferFunction transfer;
    /** For people. */
    std::string description;
};

/**
 * Of 1 to 12 breakpoints for a field with this range in a volume of this size (world length); the same for the same seed. Among
 * them constant and rough densities, narrow peaks, empty parts, and steps of colour or density.
 */
RandomTransfer random_transfer(std::uint64_t seed, double low, double high, double size);

} // namespace elvis::oracle
