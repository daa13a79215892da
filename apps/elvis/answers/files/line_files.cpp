#include "line_files.hpp"

#include <core/base/counted.hpp>

#include <array>
#include <cstdio>

namespace elvis::commands {

std::vector<LineColumn> line_columns(const data& volume, const std::vector<std::string>& fields) {
    std::vector<LineColumn> columns;
    for (const std::string& field : fields) {
        const elvis_string name = field.c_str();
        columns.push_back({field, volume.count_values(&name, 1)});
    }
    return columns;
}

void write_lines(const traced& lines, const std::vector<LineColumn>& columns, const std::string& path) {
    path.ends_with(".csv") ? write_line_csv(lines, columns, path) : write_vtp(lines, columns, path);
}

std::vector<std::string> report_of(const traced& lines) {
    std::array<std::size_t, ELVIS_LINE_TIME + 1> counts{};
    for (std::size_t line = 0; line < lines.begins.size(); ++line) {
        ++counts[lines.begins[line]];
        counts[lines.ends[line]] += lines.begins[line] != ELVIS_LINE_NO_ELEMENT ? 1 : 0;
    }
    std::vector<std::string> texts = {counted(lines.begins.size(), "line") + ", " + counted(lines.times.size(), "point")};
    for (elvis_line_end end = 0; end < counts.size(); ++end) {
        if (counts[end] > 0) {
            texts.push_back("  " + std::to_string(counts[end]) + " " + word_of(end));
        }
    }
    if (lines.time_doubt >= 0) {
        char doubt[120];
        std::snprintf(doubt, sizeof doubt,
                      "between time steps linear and cubic interpolation are up to %.2g of the largest speed apart",
                      lines.time_doubt);
        texts.emplace_back(doubt);
    }
    return texts;
}

const char* word_of(elvis_line_end end) {
    constexpr const char* words[] = {"ends where the volume ends",
                                     "ends where the field is zero",
                                     "ends at the length or the seed",
                                     "ends after as many steps as are allowed",
                                     "ends at faces where the field jumps back",
                                     "seeds in no element",
                                     "ends at the end of time, or at the seed"};
    return words[end];
}

} // namespace elvis::commands
