/**
 * @file includes.hpp
 * #include in GLSL, replaced by text before anything else looks at it.
 */
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace elvis {

/** Text of the file of this name, or an Error if there is none. The view must last as long as the expansion. */
using IncludeResolver = std::function<std::string_view(std::string_view name)>;

/**
 * Replaces every line `#include "name"` outside comments by the file's text, recursively, with #line directives that name file
 * and line, as GL_GOOGLE_cpp_style_line_directive allows. The result begins with such a directive for `name` unless the text
 * begins with #version, which must stay first. Conditions are not evaluated: include guards work, but the file is there. An
 * Error at "file:line" for a file that does not exist or includes itself without end.
 */
std::string expand_includes(std::string_view text, const std::string& name, const IncludeResolver& resolve);

} // namespace elvis
