#include "scene_edit.hpp"

#include <core/base/error.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <functional>

namespace elvis::serve {

namespace {

using nlohmann::json;

/** No scene has more levels; what walks through them calls itself. */
constexpr int most_levels = 40;

std::string unescaped(std::string word) {
    for (const auto& [code, character] : {std::pair{"~1", "/"}, std::pair{"~0", "~"}}) {
        for (std::size_t at = word.find(code); at != std::string::npos; at = word.find(code, at + 1)) {
            word.replace(at, 2, character);
        }
    }
    return word;
}

std::vector<std::string> words_of(const std::string& pointer) {
    std::vector<std::string> words;
    if (!pointer.empty() && pointer.front() != '/') {
        throw Error("the place '" + pointer + "' does not begin with '/'");
    }
    for (std::size_t at = 0; at < pointer.size();) {
        const std::size_t end = std::min(pointer.find('/', at + 1), pointer.size());
        words.push_back(unescaped(pointer.substr(at + 1, end - at - 1)));
        at = end;
    }
    if (words.empty() || words.size() > most_levels) {
        throw Error("'" + pointer + "' is no place in a scene");
    }
    return words;
}

/** Up to the number of entries, which is the place after them. */
std::size_t index_of(const json& list, const std::string& word, const std::string& pointer) {
    if (word == "-") {
        return list.size();
    }
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), index);
    if (error != std::errc{} || end != word.data() + word.size() || index > list.size()) {
        throw Error("'" + pointer + "': the list has " + std::to_string(list.size()) + " entries, and no place '" + word + "'");
    }
    return index;
}

json* step_into(json& parent, const std::string& word, const std::string& pointer) {
    if (parent.is_array()) {
        const std::size_t index = index_of(parent, word, pointer);
        if (index == parent.size()) {
            parent.push_back(json::object());
        }
        return &parent[index];
    }
    if (parent.is_null()) {
        parent = json::object();
    }
    if (!parent.is_object()) {
        throw Error("'" + pointer + "' leads into what is neither object nor list");
    }
    return &parent[word];
}

void put(json& parent, const std::string& word, const json& value, const std::string& pointer) {
    if (!parent.is_array()) {
        json* const place = step_into(parent, word, pointer);
        *place = value;
        if (value.is_null()) {
            parent.erase(word);
        }
        return;
    }
    const std::size_t index = index_of(parent, word, pointer);
    if (!value.is_null()) {
        *step_into(parent, word, pointer) = value;
    } else if (index < parent.size()) {
        parent.erase(index);
    }
}

/** Keys whose texts name files. */
bool names_file(const std::string& key) {
    constexpr std::array<std::string_view, 4> keys = {"path", "more_paths", "file", "transfer"};
    return std::ranges::find(keys, key) != keys.end();
}

using Visit = std::function<void(const std::string& path)>;

void visit_files(const json& part, bool is_file, const Visit& visit) {
    if (part.is_string() && is_file) {
        visit(part.get<std::string>());
    } else if (part.is_array()) {
        for (const json& entry : part) {
            visit_files(entry, is_file, visit);
        }
    } else if (part.is_object()) {
        for (const auto& [key, value] : part.items()) {
            visit_files(value, names_file(key), visit);
        }
    }
}

json volume_of(const json& scene) {
    json volume = scene.value("volume", json::object());
    if (volume.is_object()) {
        volume.erase("time_step");
    }
    return volume;
}

} // namespace

json parsed(std::string_view text) {
    const json::parser_callback_t look = [](int depth, json::parse_event_t, json&) {
        if (depth > most_levels) {
            throw Error("the JSON is nested too deeply");
        }
        return true;
    };
    try {
        return json::parse(text, look);
    } catch (const json::exception& error) {
        throw Error("this is no JSON: " + std::string(error.what()));
    }
}

void set_at(json& document, const std::string& pointer, const json& value) {
    const std::vector<std::string> words = words_of(pointer);
    json* parent = &document;
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        parent = step_into(*parent, words[i], pointer);
    }
    put(*parent, words.back(), value, pointer);
}

ScenePaths::ScenePaths(const std::filesystem::path& root, const json& first)
    : m_root(std::filesystem::canonical(root)), m_volume(volume_of(first)) {
    visit_files(first, false, [this](const std::string& path) { m_known.insert(path); });
}

void ScenePaths::check(const json& scene) const {
    if (!scene.is_object()) {
        throw Error("a scene is an object in braces");
    }
    if (volume_of(scene) != m_volume) {
        throw Error("'volume' is another one than what is served");
    }
    visit_files(scene.value("volumes", json()), false, [this](const std::string& path) {
        if (!m_known.contains(path)) {
            throw Error("'volumes' has another volume than what is served: '" + path + "'");
        }
    });
    check_files(scene);
}

void ScenePaths::check_files(const json& part) const {
    visit_files(part, false, [this](const std::string& path) {
        if (m_known.contains(path)) {
            return;
        }
        // Of what links lead to.
        const std::filesystem::path whole = std::filesystem::weakly_canonical(m_root / path);
        const auto [end, _] = std::mismatch(m_root.begin(), m_root.end(), whole.begin(), whole.end());
        if (end != m_root.end()) {
            throw Error("'" + path + "' lies outside of the folder that is served");
        }
    });
}

} // namespace elvis::serve
