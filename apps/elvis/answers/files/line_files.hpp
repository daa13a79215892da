/**
 * @file line_files.hpp
 * The files of `elvis streamlines` and `elvis pathlines`. Each appears whole or not at all.
 */
#pragma once

#include <elvis/elvis.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace elvis::commands {

/** A field or expression of which a file has the values. */
struct LineColumn {
    std::string name;
    std::uint32_t n_components = 1;
};

/** Those of fields and expressions, which the volume must know. */
std::vector<LineColumn> line_columns(const data& volume, const std::vector<std::string>& fields);

/** By the ending: .csv; all else is VTK's. */
void write_lines(const traced& lines, const std::vector<LineColumn>& columns, const std::string& path);

/** What was found, for people: how many lines, and why they end. Each text is a line. */
std::vector<std::string> report_of(const traced& lines);

/** As people read it: why a line begins or ends. */
const char* word_of(elvis_line_end end);

/** A row a point: the line's number, time, arc length, position, element, values. */
void write_line_csv(const traced& lines, const std::vector<LineColumn>& columns, const std::string& path);
/** VTK's PolyData: a polyline a line, `time`, `arc_length`, `element` and values at points, `begin` and `end` of lines. */
void write_vtp(const traced& lines, const std::vector<LineColumn>& columns, const std::string& path);

} // namespace elvis::commands
