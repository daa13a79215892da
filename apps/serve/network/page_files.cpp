#include "page_files.hpp"

#include "page_texts.hpp"

#include <elvis/elvis.h>

namespace elvis::serve {

std::optional<PageFile> page_file(std::string_view name) {
    if (name == "scene.schema.json") {
        return PageFile{elvis_scene_schema(), "application/json"};
    }
    const std::string file = name.empty() ? "index.html" : std::string(name);
    for (const auto& [path, text] : page_texts::files) {
        const std::string_view own = path;
        if (file == own.substr(own.rfind('/') + 1)) { // npos + 1 is 0
            const std::string ending = file.substr(file.rfind('.') + 1);
            const std::string kind = ending == "js" ? "javascript" : ending;
            return PageFile{text, ending == "svg" ? "image/svg+xml" : "text/" + kind + "; charset=utf-8"};
        }
    }
    return std::nullopt;
}

} // namespace elvis::serve
