#include "sample_files.hpp"

#include <cmath>

namespace elvis::commands {

namespace {

/** Of each point the part of its numbers that is a column's. */
std::vector<double> part(const std::vector<double>& all, std::size_t n_points, std::size_t n_numbers, std::size_t first,
                         std::size_t n) {
    std::vector<double> numbers;
    numbers.reserve(n_points * n);
    for (std::size_t point = 0; point < n_points; ++point) {
        const double* const from = all.data() + point * n_numbers + first;
        numbers.insert(numbers.end(), from, from + n);
    }
    return numbers;
}

std::vector<std::size_t> shape_of(std::size_t n_points, std::size_t n_components) {
    return n_components > 1 ? std::vector{n_points, n_components} : std::vector{n_points};
}

NamedArray elements_beside(const SampleTable& table, const char* name, std::optional<SampledBreak::Side> SampledBreak::*side) {
    std::vector<std::int64_t> elements;
    for (const SampledBreak& each : table.breaks) {
        elements.push_back(each.*side ? (each.*side)->element : -1);
    }
    return {name, {elements.size()}, std::move(elements)};
}

NamedArray values_beside(const SampleTable& table, const SampledColumn& column, const char* ending,
                         std::optional<SampledBreak::Side> SampledBreak::*side) {
    std::vector<double> values;
    for (const SampledBreak& each : table.breaks) {
        for (std::uint32_t component = 0; component < column.n_components; ++component) {
            values.push_back(each.*side ? (each.*side)->values[column.first + component] : std::nan(""));
        }
    }
    return {column.name + ending, shape_of(table.breaks.size(), column.n_components), std::move(values)};
}

void append_breaks(const SampleTable& table, std::vector<NamedArray>& arrays) {
    std::vector<double> points, arc_lengths;
    for (const SampledBreak& each : table.breaks) {
        points.insert(points.end(), each.position.begin(), each.position.end());
        arc_lengths.push_back(each.arc_length);
    }
    const std::size_t n = table.breaks.size();
    arrays.push_back({"break_points", {n, 3}, std::move(points)});
    arrays.push_back({"break_arc_length", {n}, std::move(arc_lengths)});
    arrays.push_back(elements_beside(table, "break_element_before", &SampledBreak::before));
    arrays.push_back(elements_beside(table, "break_element_after", &SampledBreak::after));
    for (const SampledColumn& column : table.columns) {
        arrays.push_back(values_beside(table, column, "_before", &SampledBreak::before));
        arrays.push_back(values_beside(table, column, "_after", &SampledBreak::after));
    }
}

} // namespace

std::size_t NamedArray::n_bytes() const {
    return std::visit([](const auto& list) { return list.size() * sizeof(list[0]); }, numbers);
}

const void* NamedArray::bytes() const {
    return std::visit([](const auto& list) -> const void* { return list.data(); }, numbers);
}

std::vector<NamedArray> arrays_of(const SampleTable& table) {
    const std::size_t n = table.points.size();
    std::vector<NamedArray> arrays;
    arrays.push_back({"points", {n, 3}, table.points.positions});
    arrays.push_back({"element", {n}, table.elements});
    if (!table.points.arc_lengths.empty()) {
        arrays.push_back({"arc_length", {n}, table.points.arc_lengths});
    }
    for (const SampledColumn& column : table.columns) {
        arrays.push_back({column.name, shape_of(n, column.n_components),
                          part(table.values, n, table.n_values, column.first, column.n_components)});
    }
    for (const SampledColumn& column : table.columns) {
        if (!table.gradients.empty()) {
            std::vector<std::size_t> shape = shape_of(n, column.n_components);
            shape.push_back(3);
            arrays.push_back({"grad(" + column.name + ")", shape,
                              part(table.gradients, n, 3 * std::size_t{table.n_values}, 3 * std::size_t{column.first},
                                   3 * std::size_t{column.n_components})});
        }
    }
    if (!table.points.corners.empty()) {
        append_breaks(table, arrays);
    }
    return arrays;
}

} // namespace elvis::commands
