/**
 * @file file_list.hpp
 * What a folder holds, for choosing a file.
 */
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace elvis::view {

struct FolderEntry {
    std::string name;
    bool is_folder = false;
};

/**
 * Folders first, both by name. Hidden ones are left out, and files whose name does not hold `filter` (small and capital letters
 * are the same). Empty if the folder cannot be read.
 */
std::vector<FolderEntry> list_folder(const std::filesystem::path& folder, const std::string& filter);

} // namespace elvis::view
