/**
 * @file page_files.hpp
 * The page, which is part of the program.
 */
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace elvis::serve {

struct PageFile {
    std::string_view text;
    std::string type;
};

/** By the last part of its address; empty: the page itself. */
std::optional<PageFile> page_file(std::string_view name);

} // namespace elvis::serve
