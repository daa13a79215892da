/**
 * @file transfer_function.hpp
 * What a volume looks like where its field has a value: how dense it is, and the colour of its light.
 */
#pragma once

#include <array>
#include <vector>

namespace elvis {

/**
 * Both functions are linear between their points and constant beyond the first and the last; two equal values make a step, of
 * which the value itself belongs to the upper side.
 */
struct TransferFunction {
    struct DensityPoint {
        double value = 0;
        /** Per world length, not negative. A ray keeps exp(-density * length) of the light behind. */
        double density = 0;
    };
    struct ColorPoint {
        double value = 0;
        /** Display values in [0, 1]: what a dense volume of this value looks like. */
        std::array<double, 3> rgb{};
    };
    /** Ascending; at least one. */
    std::vector<DensityPoint> density;
    std::vector<ColorPoint> color;
};

/**
 * Density and colour between two neighbouring breakpoints, as linear functions of the value less `from`. Where there is no
 * density, colour means nothing and is zero.
 */
struct TransferPiece {
    double from = 0;
    double density = 0, density_slope = 0;
    std::array<double, 3> rgb{}, rgb_slope{};
};

/** A transfer function cut at the breakpoints of all its channels. */
struct TransferTable {
    /** Ascending, each once. */
    std::vector<double> breakpoints;
    /** One more than breakpoints: below the first, between, above the last. */
    std::vector<TransferPiece> pieces;
    /** What colours are off at most because they have fewer breakpoints. */
    double color_error = 0;

    /** The piece that holds a value; of a breakpoint, that above it. */
    const TransferPiece& piece_at(double value) const;
};

/**
 * Breakpoints at which nothing changes, but for rounding, are left out, and with them those of colours that no density shows.
 * Where it halves the number of colours at least, colours are taken within `color_error` in each channel. Throws Error if a
 * list is empty or does not ascend, if a number is not finite, or a density below zero.
 */
TransferTable cut_at_breakpoints(const TransferFunction& transfer, double color_error = 0);

} // namespace elvis
