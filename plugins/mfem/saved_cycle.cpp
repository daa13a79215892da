#include "saved_cycle.hpp"

#include "file_content.hpp"

#include <elvis/plugin.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace elvis_mfem {

namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& path, const std::string& message) {
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, message);
}

/** A path beside the root file: "%06d" stands for the number of the part, of which only the first is there. */
std::string first_part(const std::string& root, std::string pattern) {
    const std::size_t begin = pattern.find('%'), end = pattern.find('d', begin);
    if (begin != std::string::npos && end != std::string::npos) {
        const std::string width = pattern.substr(begin + 1, end - begin - 1);
        const bool is_number = width.size() < 3 && std::ranges::all_of(width, [](char c) { return c >= '0' && c <= '9'; });
        if (!is_number) {
            fail(root, "'" + pattern.substr(0, 40) + "' is not a path with the number of a part");
        }
        pattern.replace(begin, end - begin + 1,
                        std::string(std::max<std::size_t>(1, width.empty() ? 1 : std::stoul(width)), '0'));
    }
    return (std::filesystem::path(root).parent_path() / pattern).string();
}

SavedCycle read_root(const std::string& root) {
    SavedCycle cycle;
    try {
        const Json json = Json::parse(read_content(root));
        const Json& main = json.at("dsets").at("main");
        const int n_parts = main.at("domains").get<int>();
        if (n_parts != 1) {
            throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, root,
                                    "the data lie in " + std::to_string(n_parts) +
                                        " parts of a parallel mesh, which is not supported; let MFEM save them in one file "
                                        "(Mesh::SaveAsOne, GridFunction::SaveAsOne)");
        }
        cycle.time = main.at("time").get<double>();
        cycle.mesh = first_part(root, main.at("mesh").at("path").get<std::string>());
        // A collection without fields has null in their place.
        if (const auto fields = main.find("fields"); fields != main.end()) {
            for (const auto& [name, field] : fields->items()) {
                cycle.fields.push_back({name, first_part(root, field.at("path").get<std::string>())});
            }
        }
    } catch (const Json::exception& error) {
        fail(root, std::string("this is not a root file of a VisItDataCollection: ") + error.what());
    }
    return cycle;
}

void check_same_fields(const std::string& path, const SavedCycle& first, const SavedCycle& cycle) {
    if (!std::ranges::equal(first.fields, cycle.fields, {}, &SavedField::name, &SavedField::name)) {
        fail(path, "the fields are not those of the first root file");
    }
    if (read_content(first.mesh) != read_content(cycle.mesh)) {
        throw elvis::api::Error(
            ELVIS_ERROR_UNSUPPORTED, cycle.mesh,
            "the mesh differs from that of the first root file, which is not supported: convert them one by one");
    }
}

/** The file's name without folder, ".gz" and extension, followed by a number if it is taken. */
std::string field_name(const std::string& path, const std::vector<SavedField>& others) {
    const std::filesystem::path file(path);
    const std::string stem = (file.extension() == ".gz" ? file.stem().stem() : file.stem()).string();
    std::string name = stem;
    const auto is_taken = [&](const SavedField& field) { return field.name == name; };
    for (int number = 2; std::ranges::any_of(others, is_taken); ++number) {
        name = stem + " " + std::to_string(number);
    }
    return name;
}

} // namespace

bool is_root(const std::string& path) {
    const std::string head = read_head(path, 400);
    return std::filesystem::path(path).extension() == ".mfem_root" && head.starts_with('{') &&
           head.find("\"dsets\"") != std::string::npos;
}

std::vector<SavedCycle> find_cycles(const std::vector<std::string>& paths) {
    std::vector<SavedCycle> cycles;
    if (!is_root(paths.front())) {
        SavedCycle& cycle = cycles.emplace_back();
        cycle.mesh = paths.front();
        for (std::size_t index = 1; index < paths.size(); ++index) {
            cycle.fields.push_back({field_name(paths[index], cycle.fields), paths[index]});
        }
        return cycles;
    }
    for (const std::string& path : paths) {
        SavedCycle cycle = read_root(path);
        if (!cycles.empty()) {
            check_same_fields(path, cycles.front(), cycle);
        }
        cycles.push_back(std::move(cycle));
    }
    return cycles;
}

} // namespace elvis_mfem
