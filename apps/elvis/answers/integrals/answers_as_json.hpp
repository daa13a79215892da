/**
 * @file answers_as_json.hpp
 * Integrals and extrema as `elvis integrate` and `elvis extrema` print them, and as the page in the browser gets them.
 */
#pragma once

#include <elvis/elvis.hpp>

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace elvis::commands {

nlohmann::ordered_json integral_json(const elvis_integral& integral);
/** What is to be known beside the numbers, a sentence each. */
std::vector<std::string> doubts_of(const elvis_integral& integral);

/** Throws Error if the field is not finite everywhere. */
nlohmann::ordered_json extrema_json(const std::string& field, const elvis_range& range);

} // namespace elvis::commands
