/**
 * @file tokens.hpp
 * The little that must be known of GLSL to let several snippets share one kernel: which names a text uses and which macros it
 * defines.
 */
#pragma once

#include <set>
#include <string>
#include <string_view>

namespace elvis {

/** All identifiers of a text, comments left out. */
std::set<std::string> identifiers(std::string_view text);

/** Names of the macros that a text #defines. */
std::set<std::string> defined_macros(std::string_view text);

} // namespace elvis
