/**
 * @file columns.hpp
 * What values are asked for at points.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/probe.hpp>

#include <elvis/abi.h>

#include <cstdint>
#include <vector>

namespace elvis::library {

/** What a probe is asked for: a field of the volume as it is, or an expression. */
struct Column {
    std::uint32_t field = 0;
    /** Of the list of expressions; not used for fields. */
    std::size_t expression = 0;
    bool is_field = false;
    std::uint32_t n_values = 1;
};

struct Columns {
    std::vector<Column> columns;
    ProbeWishes wishes;
    std::uint32_t n_values = 0;
};

/** Of names of fields and expressions. Throws for those that are not understood. */
Columns columns_of(const RuntimeVolume& volume, const elvis_string* fields, std::uint32_t n_fields);

/** The columns' values at points of elements, on the CPU: those of a point side by side. */
std::vector<std::vector<double>> values_at(const RuntimeVolume& volume, const Columns& columns, std::uint32_t time_step,
                                           const std::vector<ReferencePoint>& points);

} // namespace elvis::library
