/**
 * @file sums.hpp
 * What hunts found, by kind of scene and precision, as text and as a file.
 */
#pragma once

#include "judge.hpp"

#include <map>
#include <string>
#include <utility>

namespace elvis::hunt {

/** By kind and precision. */
using Sums = std::map<std::pair<std::string, std::string>, Tally>;

/** A table for people: silent errors and false alarms per million pixels, by kind, buffer and flag; pixels a second. */
std::string to_text(const Sums& sums);
bool has_silent(const Sums& sums);

void write_sums(const Sums& sums, const std::string& path);
/** Adds a file's to `sums`. */
void add_sums(const std::string& path, Sums& sums);

} // namespace elvis::hunt
