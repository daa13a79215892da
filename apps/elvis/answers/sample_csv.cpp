#include "sample_curve.hpp"

#include <core/base/csv_text.hpp>

#include <ostream>

namespace elvis::commands {

namespace {

std::string header(const SampleTable& table) {
    std::string row = table.points.arc_lengths.empty() ? "x,y,z,element" : "arc_length,x,y,z,element";
    for (const SampledColumn& column : table.columns) {
        for (std::uint32_t component = 0; component < column.n_components; ++component) {
            row.append(",").append(csv_name(column.component(component)));
        }
    }
    for (const SampledColumn& column : table.columns) {
        for (std::uint32_t component = 0; !table.gradients.empty() && component < column.n_components; ++component) {
            for (const char* axis : {"x", "y", "z"}) {
                row.append(",").append(
                    csv_name(std::string("d(").append(column.component(component)).append(",").append(axis).append(")")));
            }
        }
    }
    return row + "\n";
}

std::string row_of(const SampleTable& table, std::size_t point) {
    std::string row;
    if (!table.points.arc_lengths.empty()) {
        append_csv_number(row, table.points.arc_lengths[point]);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        append_csv_number(row, table.points.positions[3 * point + axis]);
    }
    row += ',';
    if (table.elements[point] >= 0) {
        row += std::to_string(table.elements[point]);
    }
    for (std::size_t value = 0; value < table.n_values; ++value) {
        append_csv_number(row, table.values[point * table.n_values + value]);
    }
    const std::size_t n_gradients = table.gradients.empty() ? 0 : 3 * std::size_t{table.n_values};
    for (std::size_t number = 0; number < n_gradients; ++number) {
        append_csv_number(row, table.gradients[point * n_gradients + number]);
    }
    return row.substr(1) + "\n";
}

} // namespace

void put_csv(const SampleTable& table, std::ostream& stream) {
    stream << header(table);
    for (std::size_t point = 0; point < table.points.size() && stream; ++point) {
        stream << row_of(table, point);
    }
}

} // namespace elvis::commands
