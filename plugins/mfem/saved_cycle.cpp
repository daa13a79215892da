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

/** A path beside the root file: "%06d" stands for the number of the part. */
std::string part_path(const std::string& root, std::string pattern, int part) {
    const std::size_t begin = pattern.find('%'), end = pattern.find('d', begin);
    if (begin != std::string::npos && end != std::string::npos) {
        const std::string width = pattern.substr(begin + 1, end - begin - 1);
        const bool is_number = width.size() < 3 && std::ranges::all_of(width, [](char c) { return c >= '0' && c <= '9'; });
        if (!is_number) {
            fail(root, "'" + pattern.substr(0, 40) + "' is not a path with the number of a part");
        }
        std::string number = std::to_string(part);
        const std::size_t n_digits = width.empty() ? 1 : std::stoul(width);
        number.insert(0, n_digits > number.size() ? n_digits - number.size() : 0, '0');
        pattern.replace(begin, end - begin + 1, number);
    }
    return (std::filesystem::path(root).parent_path() / pattern).string();
}

std::vector<std::string> part_paths(const std::string& root, const std::string& pattern, int n_parts) {
    std::vector<std::string> paths;
    for (int part = 0; part < n_parts; ++part) {
        paths.push_back(part_path(root, pattern, part));
    }
    return paths;
}

/** More parts than any machine has processes for. */
constexpr int most_parts = 1 << 20;

SavedCycle read_root(const std::string& root) {
    SavedCycle cycle;
    try {
        const Json json = Json::parse(read_content(root));
        const Json& main = json.at("dsets").at("main");
        const int n_parts = main.at("domains").get<int>();
        if (n_parts < 1 || n_parts > most_parts) {
            fail(root, "'domains' is " + std::to_string(n_parts) + ", which is no number of parts");
        }
        cycle.time = main.at("time").get<double>();
        cycle.meshes = part_paths(root, main.at("mesh").at("path").get<std::string>(), n_parts);
        // A collection without fields has null in their place.
        if (const auto fields = main.find("fields"); fields != main.end()) {
            for (const auto& [name, field] : fields->items()) {
                cycle.fields.push_back({name, part_paths(root, field.at("path").get<std::string>(), n_parts)});
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
    const auto differs = [](const std::string& a, const std::string& b) { return read_content(a) != read_content(b); };
    for (std::size_t part = 0; part < cycle.meshes.size(); ++part) {
        if (cycle.meshes.size() != first.meshes.size() || differs(first.meshes[part], cycle.meshes[part])) {
            throw elvis::api::Error(
                ELVIS_ERROR_UNSUPPORTED, cycle.meshes[part],
                "the mesh differs from that of the first root file, which is not supported: convert them one by one");
        }
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

namespace {

/** Of a name that ends with the number of a part, as mesh.000000 does: how many digits this has; else 0. */
std::size_t part_digits(const std::string& path) {
    constexpr std::size_t least_digits = 4;
    const std::size_t dot = path.find_last_not_of("0123456789");
    const bool is_part = dot != std::string::npos && path[dot] == '.' && path.size() - dot > least_digits;
    return is_part ? path.size() - dot - 1 : 0;
}

/** The file and, if it is a part, all parts beside it, from the first on. */
std::vector<std::string> all_parts(const std::string& path) {
    const std::size_t n_digits = part_digits(path);
    if (n_digits == 0) {
        return {path};
    }
    std::vector<std::string> paths;
    for (int part = 0; part < most_parts; ++part) {
        std::string number = std::to_string(part);
        number.insert(0, n_digits > number.size() ? n_digits - number.size() : 0, '0');
        const std::string next = path.substr(0, path.size() - n_digits) + number;
        if (!std::filesystem::exists(next)) {
            break;
        }
        paths.push_back(next);
    }
    if (std::ranges::find(paths, path) == paths.end()) {
        fail(path, "this is a part of a parallel mesh, whose parts from 0 on are not all beside it");
    }
    return paths;
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
        cycle.meshes = all_parts(paths.front());
        for (std::size_t index = 1; index < paths.size(); ++index) {
            cycle.fields.push_back({field_name(paths[index], cycle.fields), all_parts(paths[index])});
            if (cycle.fields.back().paths.size() != cycle.meshes.size()) {
                fail(paths[index], "has " + std::to_string(cycle.fields.back().paths.size()) + " part(s), but the mesh has " +
                                       std::to_string(cycle.meshes.size()));
            }
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
