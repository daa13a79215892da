#include "paths.hpp"

#include "../geometry/geometry_file.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <filesystem>

namespace nektarpp {

namespace {

namespace fs = std::filesystem;

bool has_field_extension(const fs::path& path) {
    return path.extension() == ".fld" || path.extension() == ".chk" || path.extension() == ".rst";
}

/** Files P... of an extension, by name. */
std::vector<std::string> partitions(const fs::path& folder, const auto& has_extension) {
    std::vector<std::string> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        if (entry.path().filename().string().starts_with('P') && has_extension(entry.path())) {
            files.push_back(entry.path().string());
        }
    }
    std::ranges::sort(files);
    return files;
}

std::vector<std::string> geometry_partitions(const fs::path& folder) {
    return partitions(folder, [](const fs::path& path) { return path.extension() == ".xml"; });
}

/** The files that Info.xml lists, or all partitions without one. */
FieldPaths field_partitions(const std::string& path) {
    FieldPaths step{path, partitions(path, has_field_extension), {}};
    const fs::path info = fs::path(path) / "Info.xml";
    if (!fs::exists(info)) {
        return step;
    }
    step.info = info.string();
    const XmlFile file(step.info);
    std::vector<std::string> listed;
    for (const pugi::xml_node& node : file.root().children("Partition")) {
        const fs::path name = file.attribute(node, "FileName");
        if (name.empty() || name != name.filename() || name == "..") {
            file.fail(node, "FileName is no name of a file beside Info.xml");
        }
        const std::string part = (fs::path(path) / name).string();
        if (std::ranges::find(listed, part) != listed.end()) {
            file.fail(node, "FileName " + name.string() + " is listed twice");
        }
        listed.push_back(part);
    }
    if (!listed.empty()) {
        step.parts = std::move(listed);
    }
    return step;
}

void read_geometry_of(const std::vector<std::string>& parts, const std::string& path, GeometryData& geometry) {
    if (!geometry.path.empty()) {
        throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, path,
                                "is a second geometry, after " + geometry.path + "; give one geometry and its fields");
    }
    geometry.path = path;
    for (std::size_t part = 0; part < parts.size(); ++part) {
        geometry.n_parts = static_cast<std::uint32_t>(part + 1);
        read_geometry(XmlFile(parts[part]), geometry);
    }
}

} // namespace

Input read_input(const std::vector<std::string>& paths) {
    Input input;
    for (const std::string& path : paths) {
        if (fs::is_directory(path)) {
            const std::vector<std::string> geometry = geometry_partitions(path);
            if (!geometry.empty()) {
                read_geometry_of(geometry, path, input.geometry);
                continue;
            }
            input.steps.push_back(field_partitions(path));
            if (input.steps.back().parts.empty()) {
                throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, "is a folder without files P*.xml or P*.fld");
            }
        } else if (has_field_extension(path)) {
            input.steps.push_back({path, {path}, {}});
        } else {
            const XmlFile file(path);
            if (file.root().child("GEOMETRY")) {
                read_geometry_of({path}, path, input.geometry);
            } else if (file.root().child("ELEMENTS")) {
                input.steps.push_back({path, {path}, {}});
            }
            // Else a session: conditions and parameters, which no picture needs.
        }
    }
    if (input.geometry.path.empty()) {
        throw elvis::api::Error(ELVIS_ERROR_INVALID_ARGUMENT, paths.front(),
                                "none of the files has a GEOMETRY; give the mesh (.xml), then the fields (.fld, .chk)");
    }
    return input;
}

bool holds_fields(const std::string& path) {
    return fs::is_directory(path) ? geometry_partitions(path).empty() : has_field_extension(path);
}

bool is_nektar(const char* path) noexcept {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
        return has_nektar_root(path);
    }
    for (const char* name : {"P0000000.xml", "P0000000.fld", "P0000000.chk"}) {
        try {
            if (has_nektar_root((fs::path(path) / name).c_str())) {
                return true;
            }
        } catch (const std::exception&) {
            return false;
        }
    }
    return false;
}

} // namespace nektarpp
