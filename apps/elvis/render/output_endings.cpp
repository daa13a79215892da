#include "output_endings.hpp"

#include <core/base/error.hpp>

#include <algorithm>
#include <cctype>

namespace elvis::commands {

namespace {

std::string in_lower_case(std::string name) {
    std::ranges::transform(name, name.begin(), [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return name;
}

} // namespace

void need_ending(const char* option, const std::string& name, std::initializer_list<const char*> endings) {
    const std::string lower = in_lower_case(name);
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

void need_still_ending(const char* option, const std::string& name) { need_ending(option, name, {".png", ".svg", ".pdf"}); }

void write_still(const picture& drawn, const std::string& name, std::uint32_t bits) {
    const std::string lower = in_lower_case(name);
    if (lower.ends_with(".svg")) {
        drawn.write_svg(name, bits);
    } else if (lower.ends_with(".pdf")) {
        drawn.write_pdf(name, bits);
    } else {
        drawn.write_png(name, bits);
    }
}

void need_hdf5_ending(const char* option, const std::string& name) { need_ending(option, name, {".h5", ".hdf5"}); }

void need_film_ending(const char* option, const std::string& name) {
    need_ending(option, name, {".mp4", ".m4v", ".mov", ".mkv", ".webm", ".avi", ".gif", ".ogv", ".mpg"});
}

} // namespace elvis::commands
