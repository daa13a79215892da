/**
 * @file sample_table.hpp
 * What `elvis sample` finds: values at points, and on lines, where elements begin and end.
 */
#pragma once

#include "sample_points.hpp"

#include <elvis/elvis.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace elvis::commands {

/** A field or expression. */
struct SampledColumn {
    std::string name;
    std::uint32_t n_components = 1;
    /** Of the first component, among the values of a point. */
    std::uint32_t first = 0;

    /** "u[1]", or the name if there is one component. */
    std::string component(std::uint32_t index) const;
};

/** A place of a line between two elements, or where the volume begins or ends. */
struct SampledBreak {
    double arc_length = 0;
    std::array<double, 3> position{};
    struct Side {
        std::int64_t element = 0;
        std::vector<double> values;
    };
    std::optional<Side> before, after;
};

struct SampleTable {
    SamplePoints points;
    std::vector<SampledColumn> columns;
    /** Numbers a point. */
    std::uint32_t n_values = 0;
    /** -1: in no element; -2: not known. */
    std::vector<std::int64_t> elements;
    /** NaN outside. */
    std::vector<double> values;
    /** World gradients, three numbers a value; empty if they are not wanted. */
    std::vector<double> gradients;
    /** Of lines and polylines. */
    std::vector<SampledBreak> breaks;
    /** Why there are none of a line; empty: they are there. */
    std::string no_breaks_because;

    std::size_t n_outside() const;
};

struct SampleWishes {
    /** None: all fields. */
    std::vector<std::string> fields;
    std::uint32_t time_step = 0;
    bool with_gradients = false;
};

SampleTable sample(const data& volume, SamplePoints points, const SampleWishes& wishes, const task& watch);

} // namespace elvis::commands
