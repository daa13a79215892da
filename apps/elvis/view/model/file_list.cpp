#include "file_list.hpp"

#include <algorithm>
#include <cctype>

namespace elvis::view {

namespace {

std::string lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

} // namespace

std::vector<FolderEntry> list_folder(const std::filesystem::path& folder, const std::string& filter) {
    std::vector<FolderEntry> entries;
    const std::string wanted = lower_case(filter);
    std::error_code error;
    for (auto entry = std::filesystem::directory_iterator(folder, error);
         !error && entry != std::filesystem::directory_iterator(); entry.increment(error)) {
        FolderEntry found;
        found.name = entry->path().filename().string();
        std::error_code no_status;
        found.is_folder = entry->is_directory(no_status);
        const bool is_hidden = found.name.starts_with('.');
        if (!is_hidden && (found.is_folder || lower_case(found.name).find(wanted) != std::string::npos)) {
            entries.push_back(std::move(found));
        }
    }
    std::sort(entries.begin(), entries.end(), [](const FolderEntry& a, const FolderEntry& b) {
        return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name;
    });
    return entries;
}

} // namespace elvis::view
