/**
 * @file json_reader.hpp
 * Typed access to a JSON document whose keys a JSON Schema lists: what the schema does not know is an error.
 */
#pragma once

#include <core/base/nearest_word.hpp>

#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <vector>

namespace elvis {

/** Parses a file. A syntax error names file, line and column. */
nlohmann::json parse_json_file(const std::string& path);

/** An object in a document, with its place for messages. */
class JsonObject {
public:
    /**
     * `schema`: the schema's node for this object. Every key must be among its properties, have another key's value that its
     * "with" lists, and stand beside none that its "excludes" lists.
     */
    JsonObject(const nlohmann::json& value, const nlohmann::json& schema, std::string file, std::string path);

    bool has(const char* key) const { return m_value->contains(key); }
    JsonObject object(const char* key) const;
    std::vector<JsonObject> objects(const char* key) const;
    std::string text(const char* key) const;
    std::vector<std::string> texts(const char* key) const;
    /** A text among the schema's "enum". */
    std::string word(const char* key) const;
    bool flag(const char* key) const;
    double number(const char* key) const;
    std::uint32_t integer(const char* key) const;
    /** A list of numbers of a length the schema allows, each finite and in its bounds ("items", or "prefixItems" for each). */
    std::vector<double> numbers(const char* key) const;
    /** A list of such lists. */
    std::vector<std::vector<double>> rows(const char* key) const;
    /** Throws Error if it is missing, as all that is said of a value. */
    const nlohmann::json& raw(const char* key) const;

    /** File and path of this object, for messages. */
    std::string place() const { return m_path.empty() ? m_file : m_file + ": '" + m_path + "'"; }
    [[noreturn]] void fail(const std::string& key, const std::string& what) const;

private:
    void check_other_keys(const std::string& key) const;
    const nlohmann::json& followed(const nlohmann::json& schema) const;
    /** Follows references; of "anyOf" the alternative for a value of this kind (text or object). */
    const nlohmann::json& schema_of(const char* key) const;
    double checked(const nlohmann::json& value, const nlohmann::json& schema, const std::string& key) const;
    std::vector<double> checked_list(const nlohmann::json& value, const nlohmann::json& schema, const std::string& key) const;

    const nlohmann::json* m_value;
    const nlohmann::json* m_schema;
    const nlohmann::json* m_root_schema;
    std::string m_file;
    std::string m_path;
};

} // namespace elvis
