/**
 * @file include.hpp
 * Expands #include before compilation, so that the text that is compiled is the text that is hashed, and every line keeps its
 * file.
 */
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace elvis {

/** Text of an included file, or an Error if there is none. The view lasts as long as the expansion. */
using IncludeResolver = std::function<std::string_view(std::string_view name)>;

/**
 * `text` with every `#include "name"` replaced by the named text, itself expanded, between #line directives (none before the
 * first line of `text` itself). A file that includes itself, also through others, is an Error. Include guards work as usual,
 * being left to the preprocessor.
 */
std::string expand_includes(std::string_view text, const std::string& name, const IncludeResolver& resolve);

} // namespace elvis
