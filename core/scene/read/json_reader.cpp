#include <core/base/error.hpp>
#include <core/base/whole_file.hpp>
#include <core/scene/read/json_reader.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

using Json = nlohmann::json;

Json parse_json_file(const std::string& path) {
    const std::string content = read_whole_file(path);
    try {
        return Json::parse(content);
    } catch (const Json::parse_error& error) {
        const std::size_t at = std::min(error.byte == 0 ? 0 : error.byte - 1, content.size());
        const auto line = 1 + std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        const std::size_t line_start = content.rfind('\n', at == 0 ? 0 : at - 1);
        const std::size_t column = line_start == std::string::npos ? at + 1 : at - line_start;
        throw Error(path + ":" + std::to_string(line) + ":" + std::to_string(column),
                    "is not JSON: " + std::string(error.what()));
    } catch (const Json::out_of_range& error) {
        throw Error(path, "holds a number that is too large: " + std::string(error.what()));
    }
}

namespace {

bool has_entry(const Json& list, const Json& value) { return std::find(list.begin(), list.end(), value) != list.end(); }

} // namespace

JsonObject::JsonObject(const Json& value, const Json& schema, std::string file, std::string path)
    : m_value(&value), m_schema(&schema), m_root_schema(&schema), m_file(std::move(file)), m_path(std::move(path)) {
    if (!value.is_object()) {
        throw Error(m_file, (m_path.empty() ? "the document" : "'" + m_path + "'") + " must be an object in braces");
    }
    const Json& properties = schema.at("properties");
    for (const auto& [key, ignored] : value.items()) {
        if (!properties.contains(key)) {
            std::vector<std::string> known;
            for (const auto& [name, also_ignored] : properties.items()) {
                known.push_back(name);
            }
            fail(key, "is unknown; the nearest known key is '" + nearest_word(key, known) + "'");
        }
        check_other_keys(key);
    }
    for (const Json& required : schema.value("required", Json::array())) {
        if (!value.contains(required.get<std::string>())) {
            fail(required.get<std::string>(), "is missing");
        }
    }
}

void JsonObject::check_other_keys(const std::string& key) const {
    const Json& schema = m_schema->at("properties").at(key);
    const Json with = schema.value("with", Json::object()), excluded = schema.value("excludes", Json::array());
    for (const auto& [other, values] : with.items()) {
        const Json& known = m_schema->at("properties").at(other);
        const Json value = m_value->value(other, known.value("default", Json()));
        // Other values are told of where that key is read.
        if (has_entry(known.at("enum"), value) && !has_entry(values, value)) {
            fail(key, "means nothing where '" + other + "' is " + value.dump());
        }
    }
    for (const Json& other : excluded) {
        if (m_value->contains(other.get<std::string>())) {
            fail(key, "means nothing beside '" + other.get<std::string>() + "'; give one of the two");
        }
    }
}

const Json& JsonObject::raw(const char* key) const {
    if (!has(key)) {
        fail(key, "is missing");
    }
    return m_value->at(key);
}

void JsonObject::fail(const std::string& key, const std::string& what) const {
    throw Error(m_file, "'" + (m_path.empty() ? key : m_path + "." + key) + "' " + what);
}

const Json& JsonObject::followed(const Json& schema) const {
    const auto reference = schema.find("$ref");
    return reference == schema.end() ? schema : m_root_schema->at(Json::json_pointer(reference->get<std::string>().substr(1)));
}

const Json& JsonObject::schema_of(const char* key) const {
    const Json& schema = followed(m_schema->at("properties").at(key));
    if (const auto alternatives = schema.find("anyOf"); alternatives != schema.end()) {
        for (const Json& alternative : *alternatives) {
            const Json& one = followed(alternative);
            const Json& value = raw(key);
            if (one.contains(value.is_string() ? "enum" : value.is_array() ? "items" : "properties")) {
                return one;
            }
        }
    }
    return schema;
}

JsonObject JsonObject::object(const char* key) const {
    JsonObject child(raw(key), schema_of(key), m_file, m_path.empty() ? key : m_path + "." + key);
    child.m_root_schema = m_root_schema;
    return child;
}

std::vector<JsonObject> JsonObject::objects(const char* key) const {
    if (!raw(key).is_array()) {
        fail(key, "must be a list");
    }
    if (raw(key).size() < schema_of(key).value("minItems", std::size_t{0})) {
        fail(key, "is empty");
    }
    std::vector<JsonObject> children;
    for (std::size_t index = 0; index < raw(key).size(); ++index) {
        children.emplace_back(raw(key)[index], schema_of(key).at("items"), m_file,
                              (m_path.empty() ? "" : m_path + ".") + key + "[" + std::to_string(index) + "]");
        children.back().m_root_schema = m_root_schema;
    }
    return children;
}

std::string JsonObject::text(const char* key) const {
    if (!raw(key).is_string()) {
        fail(key, "is " + raw(key).dump() + ", where a text is expected");
    }
    return raw(key).get<std::string>();
}

std::vector<std::string> JsonObject::texts(const char* key) const {
    const Json& list = raw(key);
    if (!list.is_array() || !std::all_of(list.begin(), list.end(), [](const Json& one) { return one.is_string(); })) {
        fail(key, "must be a list of texts");
    }
    return list.get<std::vector<std::string>>();
}

std::string JsonObject::word(const char* key) const {
    const Json& allowed = schema_of(key).at("enum");
    if (!has_entry(allowed, raw(key))) {
        fail(key, "is " + raw(key).dump() + "; allowed are " + allowed.dump());
    }
    return raw(key).get<std::string>();
}

bool JsonObject::flag(const char* key) const {
    if (!raw(key).is_boolean()) {
        fail(key, "is " + raw(key).dump() + ", where true or false is expected");
    }
    return raw(key).get<bool>();
}

double JsonObject::checked(const Json& value, const Json& schema, const std::string& key) const {
    const bool is_integer = schema.value("type", "") == "integer";
    if (is_integer ? !value.is_number_integer() : !value.is_number()) {
        fail(key, "is " + value.dump() + ", where " + (is_integer ? "an integer" : "a number") + " is expected");
    }
    const double number = value.get<double>();
    const bool in_range = std::isfinite(number) && !(schema.contains("minimum") && number < schema["minimum"].get<double>()) &&
                          !(schema.contains("maximum") && number > schema["maximum"].get<double>()) &&
                          !(schema.contains("exclusiveMinimum") && number <= schema["exclusiveMinimum"].get<double>()) &&
                          !(schema.contains("exclusiveMaximum") && number >= schema["exclusiveMaximum"].get<double>());
    if (!in_range) {
        std::string bounds;
        for (const auto& [name, words] : {std::pair{"minimum", "at least "}, std::pair{"exclusiveMinimum", "above "},
                                          std::pair{"maximum", "at most "}, std::pair{"exclusiveMaximum", "below "}}) {
            if (schema.contains(name)) {
                bounds += (bounds.empty() ? "" : ", ") + std::string(words) + schema[name].dump();
            }
        }
        fail(key, "is " + value.dump() + "; it must be " + (bounds.empty() ? "finite" : bounds));
    }
    return number;
}

double JsonObject::number(const char* key) const { return checked(raw(key), schema_of(key), key); }

std::uint32_t JsonObject::integer(const char* key) const {
    const Json& schema = schema_of(key);
    if (schema.contains("const")) {
        if (raw(key) != schema["const"]) {
            fail(key, "is " + raw(key).dump() + "; this program knows " + schema["const"].dump());
        }
        return schema["const"].get<std::uint32_t>();
    }
    const double value = checked(raw(key), schema, key);
    if (value > 4294967295.0) {
        fail(key, "is too large");
    }
    return static_cast<std::uint32_t>(value);
}

std::vector<double> JsonObject::checked_list(const Json& value, const Json& schema, const std::string& key) const {
    const std::size_t least = schema.value("minItems", std::size_t{0});
    const std::size_t most = schema.value("maxItems", std::size_t{1} << 30);
    if (!value.is_array() || value.size() < least || value.size() > most) {
        fail(key, "is " + value.dump() + ", where a list of " + std::to_string(least) +
                      (most == least ? "" : " to " + std::to_string(most)) + " numbers is expected");
    }
    std::vector<double> list;
    const auto own_schemas = schema.find("prefixItems");
    for (const Json& item : value) {
        list.push_back(checked(item, own_schemas != schema.end() ? own_schemas->at(list.size()) : schema.at("items"), key));
    }
    return list;
}

std::vector<double> JsonObject::numbers(const char* key) const { return checked_list(raw(key), schema_of(key), key); }

std::vector<std::vector<double>> JsonObject::rows(const char* key) const {
    const Json& schema = schema_of(key);
    const Json& row_schema = followed(schema.at("items"));
    if (!raw(key).is_array() || raw(key).size() < schema.value("minItems", std::size_t{0})) {
        fail(key, raw(key).is_array() ? "is empty" : "must be a list of lists");
    }
    std::vector<std::vector<double>> result;
    for (const Json& row : raw(key)) {
        result.push_back(checked_list(row, row_schema, std::string(key) + "[" + std::to_string(result.size()) + "]"));
    }
    return result;
}

} // namespace elvis
