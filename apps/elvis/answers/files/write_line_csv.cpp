#include "line_files.hpp"
#include <core/base/csv_text.hpp>

#include <core/base/output_file.hpp>

namespace elvis::commands {

void write_line_csv(const traced& lines, const std::vector<LineColumn>& columns, const std::string& path) {
    std::string text = "line,time,arc_length,x,y,z,element";
    for (const LineColumn& column : columns) {
        for (std::uint32_t component = 0; component < column.n_components; ++component) {
            std::string name = column.name;
            if (column.n_components > 1) {
                name.append("[").append(std::to_string(component)).append("]");
            }
            text.append(",").append(csv_name(name));
        }
    }
    text += '\n';
    for (std::size_t line = 0; line + 1 < lines.first.size(); ++line) {
        for (std::uint64_t point = lines.first[line]; point < lines.first[line + 1]; ++point) {
            text.append(std::to_string(line));
            append_csv_number(text, lines.times[point]);
            append_csv_number(text, lines.arc_lengths[point]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                append_csv_number(text, lines.positions[3 * point + axis]);
            }
            text.append(",").append(std::to_string(lines.elements[point]));
            for (std::size_t value = 0; value < lines.n_values; ++value) {
                append_csv_number(text, lines.values[point * lines.n_values + value]);
            }
            text += '\n';
        }
    }
    write_text_file(path, text);
}

} // namespace elvis::commands
