/**
 * @file nearest_word.hpp
 * For messages about words that are unknown.
 */
#pragma once

#include <string>
#include <vector>

namespace elvis {

/** The known word nearest to one that is unknown, by edits; empty if none is known. */
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

} // namespace elvis
