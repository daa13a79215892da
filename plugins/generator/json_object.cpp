#include "json_object.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace generator {
namespace {

// Levenshtein's distance: fewest insertions, deletions and replacements.
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

template <class Names> std::string nearest(const std::string& word, const Names& names) {
    return *std::ranges::min_element(names, {}, [&](const std::string& name) { return edit_distance(word, name); });
}

} // namespace

JsonObject::JsonObject(const nlohmann::json& object, std::string path, std::string prefix,
                       const std::vector<std::string>& known)
    : m_object(object), m_path(std::move(path)), m_prefix(std::move(prefix)) {
    for (const auto& [key, value] : m_object.items())
        if (std::ranges::find(known, key) == known.end())
            fail(key, "is not known; did you mean \"" + nearest(key, known) + "\"?");
}

void JsonObject::fail(const std::string& key, const std::string& message) const {
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_path, "key \"" + m_prefix + key + "\": " + message);
}

void JsonObject::fail_choice(const std::string& key, const std::string& value, const std::vector<std::string>& names) const {
    fail(key, "\"" + value + "\" is not known; did you mean \"" + nearest(value, names) + "\"?");
}

const nlohmann::json& JsonObject::take(const std::string& key) const {
    if (!has(key))
        fail(key, "is missing");
    return m_object.at(key);
}

double JsonObject::number(const std::string& key) const {
    const nlohmann::json& value = take(key);
    if (!value.is_number())
        fail(key, "must be a number");
    return value.get<double>();
}

std::string JsonObject::text(const std::string& key) const {
    const nlohmann::json& value = take(key);
    if (!value.is_string())
        fail(key, "must be a text");
    return value.get<std::string>();
}

std::vector<double> JsonObject::numbers(const std::string& key, std::size_t least, std::size_t most) const {
    const nlohmann::json& value = take(key);
    if (value.is_number())
        return {value.get<double>()};
    if (!value.is_array() || value.size() < least || value.size() > most ||
        !std::ranges::all_of(value, [](const nlohmann::json& entry) { return entry.is_number(); }))
        fail(key, "must be a number or a list of numbers, at most " + std::to_string(most));
    return value.get<std::vector<double>>();
}

std::uint32_t JsonObject::whole(const std::string& key, double value, std::uint32_t lower, std::uint32_t upper) const {
    if (!(value >= lower && value <= upper && value == std::floor(value)))
        fail(key, "must be a whole number from " + std::to_string(lower) + " to " + std::to_string(upper));
    return static_cast<std::uint32_t>(value);
}

} // namespace generator
