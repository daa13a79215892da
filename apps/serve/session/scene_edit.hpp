/**
 * @file scene_edit.hpp
 * Changes of a scene's JSON that come from a page: made here, judged by the library.
 */
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace elvis::serve {

/** Of a text from outside; throws Error where it is no JSON or nested deeper than any scene. */
nlohmann::json parsed(std::string_view text);

/**
 * Puts a value at a place that a JSON Pointer (RFC 6901) names: objects on the way are made, "-" or the number of its entries
 * appends to a list; null removes. Throws Error where the pointer leads nowhere.
 */
void set_at(nlohmann::json& document, const std::string& pointer, const nlohmann::json& value);

/** Which files scenes may name: those below one folder, and those of the first scene. */
class ScenePaths {
public:
    /** `first`: what the page sees, with paths as seen from `root`. */
    ScenePaths(const std::filesystem::path& root, const nlohmann::json& first);

    /** Throws Error if the scene has other volumes, or names a file that it may not. */
    void check(const nlohmann::json& scene) const;

private:
    void check_files(const nlohmann::json& part) const;

    std::filesystem::path m_root;
    nlohmann::json m_volume;
    std::set<std::string> m_known;
};

} // namespace elvis::serve
