/**
 * @file compare.hpp
 * A frame of the renderer against the oracle's picture.
 */
#pragma once

#include "picture.hpp"

#include <string>

namespace elvis::oracle {

struct Disagreement {
    std::size_t pixel = 0;
    bool is_inside_oracle = false;
    /** distance_to_edge of the pixel's position. */
    double edge_distance = 0;
};

struct Comparison {
    std::size_t pixels = 0;
    std::size_t both_inside = 0;
    /** Over all pixels that both call inside, but for flagged ones that show one of the oracle's alternatives. */
    double max_channel_error = 0;
    std::size_t worst_pixel = 0;
    double max_value_error = 0;
    double max_depth_error = 0;
    /** Pixels that show an alternative (another element that rounding may choose) and are flagged undecided. */
    std::size_t flagged_alternatives = 0;
    /** Pixels flagged undecided where the oracle knows of no alternative: overcautious, not wrong. */
    std::size_t needless_flags = 0;
    std::size_t newton_failures = 0;
    /** Pixels that both call inside, with different element numbers. */
    std::size_t other_element = 0;
    std::vector<Disagreement> disagreements;
    double max_edge_distance = 0;

    double disagreement_share() const {
        return pixels == 0 ? 0 : static_cast<double>(disagreements.size()) / static_cast<double>(pixels);
    }
};

/** `color_tolerance`: what counts as showing an alternative. */
Comparison compare(const Model& model, const Picture& exact, const Frame& frame, double color_tolerance = 1e-3);

/** One line for people. */
std::string to_text(const Comparison& comparison);

} // namespace elvis::oracle
