/**
 * @file simpler_colors.hpp
 * Colours of fewer points, that look the same.
 */
#pragma once

#include <core/render/volume/transfer_function.hpp>

#include <vector>

namespace elvis {

/**
 * Ascending points between which colours are linear, within `error` of what they are between those of `points`, in each channel
 * and at each value. Steps stay where they are. It is the swing filter (Elmeleegy et al., Online piece-wise linear
 * approximation of numerical streams with precision guarantees, VLDB 2009): a line swings about its beginning as long as it can
 * pass all points so far.
 */
std::vector<TransferFunction::ColorPoint> simpler_colors(const std::vector<TransferFunction::ColorPoint>& points, double error);

} // namespace elvis
