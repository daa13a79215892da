#include "partner_files.hpp"

#include "../reader/text/paths.hpp"

#include <elvis/plugin.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <optional>

namespace nektarpp {

namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

std::optional<std::uint64_t> number(std::string_view text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/** Files in a folder whose names are `before`, a number, `after`, by that number. */
std::vector<std::string> numbered(const fs::path& folder, const std::string& before, const std::string& after) {
    std::vector<std::pair<std::uint64_t, std::string>> found;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.size() > before.size() + after.size() && name.starts_with(before) && name.ends_with(after)) {
            const auto in_between = std::string_view(name).substr(before.size(), name.size() - before.size() - after.size());
            if (const auto value = number(in_between)) {
                found.emplace_back(*value, (folder / name).string());
            }
        }
    }
    std::ranges::sort(found);
    std::vector<std::string> paths;
    for (auto& [value, path] : found) {
        paths.push_back(std::move(path));
    }
    return paths;
}

/** The name without the ending by which a mesh is known. */
std::string stem_of_mesh(const fs::path& mesh) {
    std::string name = mesh.filename().string();
    for (const std::string_view ending : {".xml", "_xml"}) {
        if (name.ends_with(ending)) {
            name.resize(name.size() - ending.size());
            break;
        }
    }
    return name;
}

/** SESSION.fld, or else SESSION_0.chk, SESSION_1.chk, ..; nothing if there are none. */
std::vector<std::string> fields_beside(const fs::path& mesh) {
    const std::string stem = stem_of_mesh(mesh);
    const fs::path result = mesh.parent_path() / (std::string(stem) += ".fld");
    if (is_there(result)) {
        return {result.string()};
    }
    return numbered(mesh.parent_path(), std::string(stem) += "_", ".chk");
}

std::string mesh_beside(const fs::path& field) {
    const std::string stem = field.stem().string();
    std::vector<std::string> stems{stem};
    const std::size_t mark = stem.rfind('_');
    if (mark != std::string::npos && number(std::string_view(stem).substr(mark + 1))) {
        stems.push_back(stem.substr(0, mark));
    }
    std::string tried;
    for (const std::string& of : stems) {
        for (const char* ending : {".xml", "_xml"}) {
            const fs::path mesh = field.parent_path() / (std::string(of) += ending);
            if (is_there(mesh)) {
                return mesh.string();
            }
            tried += (tried.empty() ? "" : ", ") + mesh.filename().string();
        }
    }
    throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, field.string(),
                            "holds fields, but beside it is no mesh called " + tried +
                                ". Name it by the volume's options in a scene: {\"mesh\": \"MESH.xml\"}; or convert both: "
                                "elvis convert MESH.xml " +
                                field.string() + " -o volume.h5");
}

/** What the options name, relative to the folder of the path that is opened. */
class Options {
public:
    Options(const std::string& path, const std::string& text) : m_path(path) {
        if (text.empty()) {
            return;
        }
        const auto json = nlohmann::json::parse(text, nullptr, false);
        if (!json.is_object()) {
            fail("are no JSON object");
        }
        for (const auto& [key, value] : json.items()) {
            if (key == "mesh" && value.is_string()) {
                m_mesh = beside(value.get<std::string>());
            } else if (key == "fields" && value.is_string()) {
                add_fields(value.get<std::string>());
            } else if (key == "fields" && value.is_array() &&
                       std::ranges::all_of(value, [](const auto& name) { return name.is_string(); })) {
                m_fields.emplace();
                for (const auto& name : value) {
                    add_fields(name.template get<std::string>());
                }
            } else {
                fail(std::string("'") + key +
                     "': known are 'mesh', the name of a file, and 'fields', the name of one or a list of names");
            }
        }
    }

    const std::optional<std::string>& mesh() const { return m_mesh; }
    const std::optional<std::vector<std::string>>& fields() const { return m_fields; }

private:
    std::string beside(const std::string& name) const { return (fs::path(m_path).parent_path() / name).string(); }

    void add_fields(const std::string& name) {
        if (!m_fields) {
            m_fields.emplace();
        }
        const fs::path path = beside(name);
        const std::string file = path.filename().string();
        const std::size_t star = file.find('*');
        if (star == std::string::npos) {
            m_fields->push_back(path.string());
            return;
        }
        const std::vector<std::string> found = numbered(path.parent_path(), file.substr(0, star), file.substr(star + 1));
        if (found.empty()) {
            fail(std::string("'fields': no file has a name like ") + path.string() + ", where * stands for a number");
        }
        m_fields->insert(m_fields->end(), found.begin(), found.end());
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, m_path, std::string("the volume's options: ") + what);
    }

    std::string m_path;
    std::optional<std::string> m_mesh;
    std::optional<std::vector<std::string>> m_fields;
};

} // namespace

std::vector<std::string> find_files(const std::string& path, const std::string& options) {
    const Options named(path, options);
    if (fs::is_directory(path) && !is_nektar(path.c_str())) {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, "is a folder without files P0000000.xml or P0000000.fld");
    }
    const bool is_field = holds_fields(path);
    std::string mesh = path;
    if (named.mesh()) {
        if (!is_field) {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, path,
                                    "is a mesh, and the volume's options name another: " + *named.mesh());
        }
        mesh = *named.mesh();
    } else if (is_field) {
        mesh = mesh_beside(path);
    }
    std::vector<std::string> files{mesh};
    if (is_field) {
        files.push_back(path);
    }
    if (named.fields()) {
        files.insert(files.end(), named.fields()->begin(), named.fields()->end());
    } else if (!is_field) {
        const std::vector<std::string> fields = fields_beside(path);
        files.insert(files.end(), fields.begin(), fields.end());
    }
    return files;
}

} // namespace nektarpp
