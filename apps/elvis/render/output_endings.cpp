#include "output_endings.hpp"

#include <core/base/error.hpp>

#include <algorithm>
#include <cctype>

namespace elvis::commands {

void need_ending(const char* option, const std::string& name, std::initializer_list<const char*> endings) {
    std::string lower = name;
    std::ranges::transform(lower, lower.begin(), [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    std::string list;
    for (const char* ending : endings) {
        // A name that is an ending and nothing else has none.
        if (lower.ends_with(ending) && !lower.ends_with(std::string("/") + ending) && lower != ending) {
            return;
        }
        list += (list.empty() ? "" : " or ") + std::string(ending);
    }
    throw UsageError(option, "'" + name + "' does not end in " + list + ", which is what is written");
}

void need_picture_ending(const char* option, const std::string& name) { need_ending(option, name, {".png"}); }

void need_still_ending(const char* option, const std::string& name) { need_ending(option, name, {".png", ".svg"}); }

bool is_svg(const std::string& name) {
    std::string lower = name;
    std::ranges::transform(lower, lower.begin(), [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return lower.ends_with(".svg");
}

void need_hdf5_ending(const char* option, const std::string& name) { need_ending(option, name, {".h5", ".hdf5"}); }

void need_film_ending(const char* option, const std::string& name) {
    need_ending(option, name, {".mp4", ".m4v", ".mov", ".mkv", ".webm", ".avi", ".gif", ".ogv", ".mpg"});
}

} // namespace elvis::commands
