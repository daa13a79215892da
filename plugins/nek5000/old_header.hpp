/**
 * @file old_header.hpp
 * Headers of files before 2006, NAME.fld01.
 */
#pragma once

#include "field_code.hpp"

#include <string_view>

namespace elvis_nek5000 {

/**
 * What the first 80 bytes may say. They were written in three ways, with columns that lie elsewhere and without a mark that
 * tells which: the size of the file decides.
 */
std::vector<Content> parse_old_header(std::string_view text);

} // namespace elvis_nek5000
