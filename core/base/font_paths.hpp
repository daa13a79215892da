/**
 * @file font_paths.hpp
 * Where fonts are.
 */
#pragma once

#include <string>
#include <vector>

namespace elvis {

/** Where the font is looked for if no file is named, in this order: DejaVu Sans of the common distributions. */
std::vector<std::string> default_font_paths();

} // namespace elvis
