#include "input.hpp"

#include "mesh.hpp"
#include "state.hpp"

#include <filesystem>

namespace elvis_hopr {

namespace {

std::string find_mesh(const std::string& state) {
    elvis::nodal::NodalSpaces spaces;
    const std::string name = State(elvis::hdf5::File(state), spaces).mesh_file();
    // The solver ran elsewhere: of its path only the name counts.
    const std::filesystem::path beside = std::filesystem::path(state).parent_path() / std::filesystem::path(name).filename();
    std::error_code ignored;
    if (name.empty() || !std::filesystem::is_regular_file(beside, ignored)) {
        throw elvis::api::Error(ELVIS_ERROR_FILE, state,
                                "belongs to the mesh '" + name + "', which is not beside it; name the mesh, too");
    }
    return beside.string();
}

} // namespace

std::uint32_t probe(const std::string& path) {
    if (!elvis::hdf5::is_hdf5(path)) {
        return 0;
    }
    try {
        const elvis::hdf5::File file(path);
        return is_mesh(file) || is_state(file) ? 100 : 0;
    } catch (const elvis::api::Error&) {
        return 0;
    }
}

Input find_input(const std::vector<std::string>& paths) {
    Input input;
    for (const std::string& path : paths) {
        const elvis::hdf5::File file(path);
        if (is_state(file)) {
            input.states.push_back(path);
        } else if (!is_mesh(file)) {
            file.fail("", "is neither a HOPR mesh nor a state of FLEXI or PICLas");
        } else if (!input.mesh.empty()) {
            throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, path, "is a second mesh beside " + input.mesh);
        } else {
            input.mesh = path;
        }
    }
    if (input.mesh.empty()) {
        input.mesh = find_mesh(input.states.front());
    }
    return input;
}

} // namespace elvis_hopr
