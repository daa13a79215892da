/**
 * @file json_object.hpp
 * Strict reading of a JSON object: wrong types and unknown keys are errors that name the key.
 */
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace generator {

class JsonObject {
public:
    /**
     * Fails if the object has a key that is not among `known`. Failures are elvis::api::Error for the file `path`; `prefix`
     * stands before keys in their text, e.g. "fields[1].". The object must outlive this.
     */
    JsonObject(const nlohmann::json& object, std::string path, std::string prefix, const std::vector<std::string>& known);

    const std::string& path() const { return m_path; }

    [[noreturn]] void fail(const std::string& key, const std::string& message) const;

    bool has(const std::string& key) const { return m_object.contains(key); }
    const nlohmann::json& take(const std::string& key) const;
    double number(const std::string& key) const;
    std::string text(const std::string& key) const;
    /** A number, or a list of at least `least` and at most `most`. */
    std::vector<double> numbers(const std::string& key, std::size_t least, std::size_t most) const;
    /** Checks that a value of `key` is a whole number in [lower, upper]. */
    std::uint32_t whole(const std::string& key, double value, std::uint32_t lower, std::uint32_t upper) const;

    /** One of the named values. */
    template <class T> T choice(const std::string& key, const std::vector<std::pair<std::string, T>>& choices) const {
        const std::string value = text(key);
        std::vector<std::string> names;
        for (const auto& [name, result] : choices) {
            if (name == value)
                return result;
            names.push_back(name);
        }
        fail_choice(key, value, names);
    }

private:
    [[noreturn]] void fail_choice(const std::string& key, const std::string& value,
                                  const std::vector<std::string>& names) const;

    const nlohmann::json& m_object;
    std::string m_path;
    std::string m_prefix;
};

} // namespace generator
