/**
 * @file field_plan.hpp
 * Which fields are converted, and what the conversion finds out about each.
 */
#pragma once

#include <core/convert/convert.hpp>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace elvis {

struct FieldPlan {
    std::uint32_t source_index = 0;
    /** Where its components begin among the numbers of a sample. */
    std::size_t first_value = 0;
    std::size_t n_components = 1;
    /** What is wanted: the source's label, or the user's. */
    elvis_continuity continuity = ELVIS_CONTINUITY_UNKNOWN;
    elvis_transform transform = ELVIS_TRANSFORM_NONE;
};

/** The fields that the options ask for, in their order; Error that lists the fields for a name that is not there. */
std::vector<FieldPlan> plan_fields(const SourceVolume& source, const ConvertOptions& options);

/** Merged in any order with the same result. */
struct FieldMeasure {
    double largest_error = 0;
    double lower = std::numeric_limits<double>::infinity();
    double upper = -std::numeric_limits<double>::infinity();
    std::uint64_t n_not_finite = 0;

    void merge(const FieldMeasure& other) {
        largest_error = std::max(largest_error, other.largest_error);
        lower = std::min(lower, other.lower);
        upper = std::max(upper, other.upper);
        n_not_finite += other.n_not_finite;
    }
};

} // namespace elvis
