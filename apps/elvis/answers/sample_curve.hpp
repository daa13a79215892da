/**
 * @file sample_curve.hpp
 * What was sampled along a line, as curves to be drawn, and as text.
 */
#pragma once

#include "sample_table.hpp"

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

namespace elvis::commands {

/** A component's values over the arc length: both values at each place where an element begins or ends, NaN where it jumps. */
struct SampledCurve {
    std::string name;
    std::vector<std::array<double, 2>> points;
};

/** One of each component of each column. */
std::vector<SampledCurve> curves_of(const SampleTable& table);

/** Comma-separated values, a row a point. */
void put_csv(const SampleTable& table, std::ostream& stream);

} // namespace elvis::commands
