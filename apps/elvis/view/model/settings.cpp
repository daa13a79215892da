#include "settings.hpp"

#include <core/base/output_file.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace elvis::view {

namespace {

/** The value under a key if it is there and of that type, between these limits. */
template <class T> void take(const nlohmann::json& json, const char* key, T& value, T least, T most) {
    const auto found = json.find(key);
    if (found != json.end() && found->is_number()) {
        value = std::clamp(found->get<T>(), least, most);
    }
}

} // namespace

void Settings::add_recent(const std::string& path) {
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(path, error);
    const std::string text = error ? path : absolute.lexically_normal().string();
    std::erase(recent_files, text);
    recent_files.insert(recent_files.begin(), text);
    if (recent_files.size() > most_recent_files) {
        recent_files.resize(most_recent_files);
    }
    folder = std::filesystem::path(text).parent_path().string();
}

std::filesystem::path settings_file() {
    const char* config = std::getenv("XDG_CONFIG_HOME");
    if (config != nullptr && *config != '\0') {
        return std::filesystem::path(config) / "elvis" / "view.json";
    }
    const char* home = std::getenv("HOME");
    if (home != nullptr && *home != '\0') {
        return std::filesystem::path(home) / ".config" / "elvis" / "view.json";
    }
    return {};
}

Settings read_settings(const std::filesystem::path& file) {
    Settings settings;
    std::ifstream stream(file);
    const nlohmann::json json = nlohmann::json::parse(stream, nullptr, false);
    if (!json.is_object()) {
        return settings;
    }
    if (const auto recent = json.find("recent_files"); recent != json.end() && recent->is_array()) {
        for (const nlohmann::json& path : *recent) {
            if (path.is_string() && settings.recent_files.size() < Settings::most_recent_files) {
                settings.recent_files.push_back(path.get<std::string>());
            }
        }
    }
    if (const auto folder = json.find("folder"); folder != json.end() && folder->is_string()) {
        settings.folder = folder->get<std::string>();
    }
    take(json, "window_width", settings.window_size[0], 400, 16384);
    take(json, "window_height", settings.window_size[1], 300, 16384);
    take(json, "left_panel", settings.panel_widths[0], 150.0f, 2000.0f);
    take(json, "right_panel", settings.panel_widths[1], 150.0f, 2000.0f);
    take(json, "text_scale", settings.text_scale, 0.5f, 4.0f);
    if (const auto dark = json.find("dark"); dark != json.end() && dark->is_boolean()) {
        settings.is_dark = dark->get<bool>();
    }
    return settings;
}

bool write_settings(const Settings& settings, const std::filesystem::path& file) {
    if (file.empty()) {
        return false;
    }
    nlohmann::ordered_json json;
    json["recent_files"] = settings.recent_files;
    json["folder"] = settings.folder;
    json["window_width"] = settings.window_size[0];
    json["window_height"] = settings.window_size[1];
    json["left_panel"] = settings.panel_widths[0];
    json["right_panel"] = settings.panel_widths[1];
    json["text_scale"] = settings.text_scale;
    json["dark"] = settings.is_dark;
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    try {
        write_text_file(file.string(), json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
    } catch (const std::exception&) {
        return false;
    }
    return true;
}

} // namespace elvis::view
