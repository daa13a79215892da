#include "description.hpp"

#include "fields.hpp"

#include <elvis/plugin.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

namespace generator {

namespace {

using nlohmann::json;

const std::vector<std::string> known_keys = {"generator", "mesh",   "shape", "box",    "elements",  "geometry_order",
                                             "order",     "degree", "field", "fields", "time_steps"};
const std::vector<std::string> known_meshes = {"box", "waves", "ball", "hemisphere", "shell", "torus", "twisted-tetrahedron"};
const std::vector<std::string> known_shapes = {"hexahedron", "prism", "tetrahedron", "pyramid", "mixed"};
constexpr std::uint32_t max_order = 30;

/** Edits that lead from one word to the other (Levenshtein). */
std::size_t edit_distance(const std::string& from, const std::string& to) {
    std::vector<std::size_t> row(to.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= from.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= to.size(); ++j) {
            const std::size_t replaced = diagonal + (from[i - 1] == to[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row[to.size()];
}

const std::string& nearest(const std::string& word, const std::vector<std::string>& known) {
    return *std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
        return edit_distance(word, a) < edit_distance(word, b);
    });
}

std::string list(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) {
        text += (text.empty() ? "" : ", ") + word;
    }
    return text;
}

/** Typed access to the keys of one file. */
class Keys {
public:
    Keys(const json& root, const std::string& path) : m_root(root), m_path(path) {
        if (!root.is_object()) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, "the file holds no JSON object");
        }
        for (const auto& [key, value] : root.items()) {
            if (std::find(known_keys.begin(), known_keys.end(), key) == known_keys.end()) {
                fail(key, "is unknown; the nearest known key is '" + nearest(key, known_keys) + "'");
            }
        }
    }

    [[noreturn]] void fail(const std::string& key, const std::string& what) const {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_path, "key '" + key + "' " + what);
    }

    bool has(const std::string& key) const { return m_root.contains(key); }

    std::uint32_t integer(const json& value, const std::string& key, std::uint32_t low, std::uint32_t high) const {
        if (!value.is_number_integer() || value.get<std::int64_t>() < low || value.get<std::int64_t>() > high) {
            fail(key, "is " + value.dump() + ", where an integer from " + std::to_string(low) + " to " + std::to_string(high) +
                          " is expected");
        }
        return value.get<std::uint32_t>();
    }

    std::uint32_t integer(const std::string& key, std::uint32_t low, std::uint32_t high) const {
        return integer(m_root.at(key), key, low, high);
    }

    std::string word(const json& value, const std::string& key, const std::vector<std::string>& known) const {
        if (!value.is_string() || std::find(known.begin(), known.end(), value.get<std::string>()) == known.end()) {
            fail(key, "is " + value.dump() + "; known are " + list(known));
        }
        return value.get<std::string>();
    }

    std::string word(const std::string& key, const std::vector<std::string>& known) const {
        return word(m_root.at(key), key, known);
    }

    const json& array(const std::string& key, std::size_t size) const {
        const json& value = m_root.at(key);
        if (!value.is_array() || value.size() != size) {
            fail(key, "is " + value.dump() + ", where a list of " + std::to_string(size) + " is expected");
        }
        return value;
    }

    const json& root() const { return m_root; }

private:
    const json& m_root;
    std::string m_path;
};

void read_box(const Keys& keys, Description& description) {
    const json& corners = keys.array("box", 2);
    for (std::size_t end = 0; end < 2; ++end) {
        if (!corners[end].is_array() || corners[end].size() != 3) {
            keys.fail("box", "must be two corners of three numbers");
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!corners[end][axis].is_number()) {
                keys.fail("box", "must be two corners of three numbers");
            }
            description.box[end][axis] = corners[end][axis].get<double>();
        }
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!(description.box[0][axis] < description.box[1][axis]) ||
            !std::isfinite(description.box[1][axis] - description.box[0][axis])) {
            keys.fail("box", "must go from its lower to its upper corner");
        }
    }
}

void read_fields(const Keys& keys, Description& description) {
    if (keys.has("field") && keys.has("fields")) {
        keys.fail("fields", "stands beside 'field'; give one of them");
    }
    if (keys.has("field")) {
        description.fields = {keys.word("field", field_names())};
    } else if (keys.has("fields")) {
        const json& names = keys.root().at("fields");
        if (!names.is_array() || names.empty()) {
            keys.fail("fields", "must be a list of field names");
        }
        description.fields.clear();
        for (const json& name : names) {
            description.fields.push_back(keys.word(name, "fields", field_names()));
        }
    }
    std::vector<std::string> sorted = description.fields;
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
        keys.fail("fields", "names a field twice");
    }
}

} // namespace

bool is_description(const char* path) {
    std::ifstream file(path, std::ios::binary);
    std::string head(4096, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(file.gcount()));
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    return first != std::string::npos && head[first] == '{' && head.find("\"generator\"") != std::string::npos;
}

Description read_description(const std::string& path) {
    std::ifstream file(path);
    if (!file) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, path, "cannot be opened");
    }
    json root;
    try {
        root = json::parse(file);
    } catch (const json::parse_error& error) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, error.what());
    }
    const Keys keys(root, path);
    if (!keys.has("generator")) {
        keys.fail("generator", "is missing; it states the version of the file, 1");
    }
    keys.integer("generator", 1, 1);
    Description description;
    if (keys.has("mesh")) {
        description.mesh = keys.word("mesh", known_meshes);
    }
    if (keys.has("shape")) {
        description.shape = keys.word("shape", known_shapes);
    }
    if (keys.has("box")) {
        read_box(keys, description);
    }
    if (keys.has("elements")) {
        const json& counts = keys.array("elements", 3);
        for (std::size_t direction = 0; direction < 3; ++direction) {
            description.elements[direction] = keys.integer(counts[direction], "elements", 1, 4096);
        }
    }
    if (keys.has("geometry_order")) {
        description.geometry_order = keys.integer("geometry_order", 1, 8);
    }
    if (keys.has("order")) {
        description.order = keys.integer("order", 0, max_order);
    }
    if (keys.has("degree")) {
        description.degree = keys.integer("degree", 0, max_order);
    }
    if (keys.has("time_steps")) {
        description.time_steps = keys.integer("time_steps", 1, 100000);
    }
    read_fields(keys, description);
    return description;
}

} // namespace generator
