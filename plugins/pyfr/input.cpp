#include "input.hpp"

#include "mesh.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <filesystem>

namespace elvis_pyfr {

namespace {

constexpr const char* mesh_ending = ".pyfrm";

std::string uuid_of(const std::string& path) {
    try {
        const elvis::hdf5::File file(path);
        return is_mesh(file) ? find_uuid(file) : "";
    } catch (const elvis::api::Error&) {
        // A damaged file beside the solution is none of the user's.
        return "";
    }
}

std::string find_mesh(const std::string& solution) {
    const std::string uuid = find_uuid(elvis::hdf5::File(solution));
    const std::filesystem::path folder = std::filesystem::absolute(solution).parent_path();
    std::vector<std::string> candidates;
    std::error_code ignored;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        if (entry.path().extension() == mesh_ending) {
            candidates.push_back((std::filesystem::path(solution).parent_path() / entry.path().filename()).string());
        }
    }
    std::ranges::sort(candidates);
    const auto found = std::ranges::find(candidates, uuid, uuid_of);
    if (uuid.empty() || found == candidates.end()) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, solution,
                                "belongs to the mesh with the id '" + uuid + "', which is in none of the " +
                                    std::to_string(candidates.size()) + " files '*" + mesh_ending +
                                    "' beside it; name the mesh, too");
    }
    return *found;
}

} // namespace

std::uint32_t probe(const std::string& path) {
    const std::string ending = std::filesystem::path(path).extension().string();
    const bool is_named = ending == mesh_ending || ending == ".pyfrs";
    // Damaged files of these names are this plugin's to refuse.
    const std::uint32_t by_name = is_named ? 60 : 0;
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        return 0;
    }
    if (!elvis::hdf5::is_hdf5(path)) {
        return by_name;
    }
    try {
        const elvis::hdf5::File file(path);
        return file.has("mesh_uuid") || file.has("mesh-uuid") ? 100 : by_name;
    } catch (const elvis::api::Error&) {
        return by_name;
    }
}

Input find_input(const std::vector<std::string>& paths) {
    Input input;
    for (const std::string& path : paths) {
        const elvis::hdf5::File file(path);
        if (is_mesh(file)) {
            if (!input.mesh.empty()) {
                throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, path, "is a second mesh beside " + input.mesh);
            }
            input.mesh = path;
        } else if (file.has("stats")) {
            input.solutions.push_back(path);
        } else {
            file.fail("", "is neither a mesh nor a solution of PyFR");
        }
    }
    if (input.mesh.empty()) {
        input.mesh = find_mesh(input.solutions.front());
    }
    return input;
}

} // namespace elvis_pyfr
