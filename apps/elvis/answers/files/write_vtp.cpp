#include "line_files.hpp"

#include <core/base/output_file.hpp>
#include <core/base/xml_text.hpp>

#include <array>
#include <charconv>
#include <cstdio>

namespace elvis::commands {

namespace {

template <class Number> void append_number(std::string& text, Number number) {
    std::array<char, 32> digits{};
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
    text += ' ';
}

/** A DataArray element; `number(i)` is the i-th of n. */
template <class Get>
void append_array(std::string& text, const char* type, const std::string& name, std::uint32_t n_components, std::size_t n,
                  const Get& number) {
    text.append("<DataArray type=\"").append(type).append("\" Name=\"").append(xml_text(name));
    text.append("\" NumberOfComponents=\"").append(std::to_string(n_components)).append("\" format=\"ascii\">\n");
    for (std::size_t i = 0; i < n; ++i) {
        append_number(text, number(i));
    }
    text.append("\n</DataArray>\n");
}

void append_point_data(std::string& text, const traced& lines, const std::vector<LineColumn>& columns) {
    const std::size_t n = lines.times.size();
    text.append("<PointData>\n");
    append_array(text, "Float64", "time", 1, n, [&](std::size_t i) { return lines.times[i]; });
    append_array(text, "Float64", "arc_length", 1, n, [&](std::size_t i) { return lines.arc_lengths[i]; });
    append_array(text, "Int64", "element", 1, n, [&](std::size_t i) { return lines.elements[i]; });
    std::size_t first = 0;
    for (const LineColumn& column : columns) {
        append_array(text, "Float64", column.name, column.n_components, n * column.n_components, [&](std::size_t i) {
            return lines.values[i / column.n_components * lines.n_values + first + i % column.n_components];
        });
        first += column.n_components;
    }
    text.append("</PointData>\n");
}

} // namespace

void write_vtp(const traced& lines, const std::vector<LineColumn>& columns, const std::string& path) {
    // Lines without points are no cells.
    std::vector<std::size_t> cells;
    for (std::size_t line = 0; line < lines.begins.size(); ++line) {
        if (lines.first[line + 1] > lines.first[line]) {
            cells.push_back(line);
        }
    }
    const std::size_t n_points = lines.times.size();
    std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
                       "header_type=\"UInt64\">\n<PolyData>\n";
    text.append("<Piece NumberOfPoints=\"").append(std::to_string(n_points)).append("\" NumberOfLines=\"");
    text.append(std::to_string(cells.size())).append("\">\n<Points>\n");
    append_array(text, "Float64", "Points", 3, 3 * n_points, [&](std::size_t i) { return lines.positions[i]; });
    text.append("</Points>\n<Lines>\n");
    append_array(text, "Int64", "connectivity", 1, n_points, [](std::size_t i) { return i; });
    append_array(text, "Int64", "offsets", 1, cells.size(), [&](std::size_t i) { return lines.first[cells[i] + 1]; });
    text.append("</Lines>\n");
    append_point_data(text, lines, columns);
    text.append("<CellData>\n");
    append_array(text, "Int64", "line", 1, cells.size(), [&](std::size_t i) { return cells[i]; });
    append_array(text, "Int32", "begin", 1, cells.size(), [&](std::size_t i) { return lines.begins[cells[i]]; });
    append_array(text, "Int32", "end", 1, cells.size(), [&](std::size_t i) { return lines.ends[cells[i]]; });
    text.append("</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    write_text_file(path, text);
}

} // namespace elvis::commands
