/**
 * @file time_steps.hpp
 * Time steps of a base, and which nodes of its zones belong to them.
 */
#pragma once

#include "base.hpp"

namespace elvis_cgns {

struct TimeSteps {
    /** At least one. */
    std::vector<double> times{0};
    /** By step and zone: the name of its FlowSolution_t. Empty where the file does not say: then all belong to one step. */
    std::vector<std::vector<std::string>> solutions;
    /** The nodes with the coordinates. */
    std::string coordinates = "GridCoordinates";
};

/** Ends with an error where the mesh changes in time. */
TimeSteps read_time_steps(Tree& tree, const Base& base, const elvis::api::Host& host);

} // namespace elvis_cgns
