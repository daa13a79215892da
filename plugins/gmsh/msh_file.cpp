#include "msh_file.hpp"

#include <cmath>
#include <fstream>

namespace gmsh {

namespace {

Version read_format(Cursor& cursor) {
    const std::size_t begin = cursor.at();
    const auto version = cursor.text<double>();
    const auto kind = cursor.text<std::int32_t>();
    const auto size = cursor.text<std::int32_t>();
    cursor.end_of_line();
    const bool is_4 = std::abs(version - 4.1) < 1e-6;
    if (!is_4 && std::abs(version - 2.2) >= 1e-6) {
        cursor.fail_at(begin, "version " + std::to_string(version) +
                                  " of the format; 2.2 and 4.1 are read ('gmsh FILE -save -format msh41 -o OUTPUT' converts)");
    }
    if ((kind != 0 && kind != 1) || size != 8) {
        cursor.fail_at(begin, "file type " + std::to_string(kind) + " and data size " + std::to_string(size) +
                                  ", where 0 or 1 and 8 are expected");
    }
    if (kind == 1) {
        cursor.set_binary(false);
        const auto one = cursor.value<std::uint32_t>();
        if (one == 0x01000000u) {
            cursor.set_binary(true);
        } else if (one != 1) {
            cursor.fail("the mark of the byte order is neither that of a little-endian nor that of a big-endian file");
        }
    }
    return is_4 ? Version::v4_1 : Version::v2_2;
}

bool begins_section(std::string_view line) {
    const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
    return line.size() > 1 && line.size() < 80 && line[0] == '$' && !line.starts_with("$End") &&
           std::ranges::all_of(line.substr(1), is_letter);
}

/** Reads the content of a section; false if its name is none that matters here. */
bool read_section(Cursor& cursor, const std::string& section, Version version, MshFile& file) {
    if (section == "PhysicalNames") {
        read_physical_names(cursor, file.mesh);
    } else if (section == "Entities" && version == Version::v4_1) {
        read_entities(cursor, false, file.mesh);
    } else if (section == "PartitionedEntities" && version == Version::v4_1) {
        read_entities(cursor, true, file.mesh);
    } else if (section == "Nodes") {
        read_nodes(cursor, version, file.mesh);
    } else if (section == "ParametricNodes" && version == Version::v2_2) {
        read_parametric_nodes(cursor, file.mesh);
    } else if (section == "Elements") {
        read_elements(cursor, version, file.mesh);
    } else if (section == "NodeData") {
        file.data.push_back(read_data(cursor, DataKind::node));
    } else if (section == "ElementData") {
        file.data.push_back(read_data(cursor, DataKind::element));
    } else if (section == "ElementNodeData") {
        file.data.push_back(read_data(cursor, DataKind::element_node));
    } else if (section == "InterpolationScheme") {
        auto [name, scheme] = read_scheme(cursor);
        file.schemes[name] = std::move(scheme);
    } else {
        return false;
    }
    return true;
}

} // namespace

MshFile read_msh(const std::string& path, const elvis::api::Host& host) {
    Cursor cursor(path);
    MshFile file;
    std::optional<Version> version;
    const double size = static_cast<double>(cursor.left()) + 1;
    for (cursor.skip_blanks(); cursor.left() > 0; cursor.skip_blanks()) {
        host.check_cancelled();
        host.report_progress(static_cast<double>(cursor.at()) / size, "reading the mesh file");
        const std::size_t begin = cursor.at();
        const std::string_view head = cursor.line();
        if (!begins_section(head)) {
            cursor.fail_at(begin, "a line that begins a section ('$' and its name) is expected");
        }
        const std::string section(head.substr(1));
        if (section == "NOD" || section == "NOE" || section == "ELM") {
            cursor.fail_at(begin, "version 1 of the format; 2.2 and 4.1 are read");
        }
        const std::string end = "$End" + section;
        cursor.enter(section);
        if (section == "MeshFormat") {
            version = read_format(cursor);
        } else if (section != "Comments" && !version) {
            cursor.fail_at(begin, "the section stands before $MeshFormat");
        } else if (section == "Comments" || !read_section(cursor, section, *version, file)) {
            cursor.skip_past_line(end);
            cursor.enter({});
            continue;
        }
        cursor.skip_blanks();
        const std::size_t after = cursor.at();
        if (cursor.left() == 0 || cursor.line() != end) {
            cursor.fail_at(after, "'" + end + "' is expected after the last number of the section");
        }
        cursor.enter({});
    }
    if (!version) {
        cursor.fail("there is no $MeshFormat");
    }
    return file;
}

std::uint32_t probe_msh(const char* path) {
    std::ifstream file(path, std::ios::binary);
    std::string head(4096, '\0');
    file.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    head.erase(0, head.find_first_not_of(" \t\r\n"));
    if (head.starts_with("$MeshFormat")) {
        return 100;
    }
    return head.starts_with("$Comments") && head.find("\n$MeshFormat") != std::string::npos ? 90
           : head.starts_with("$NOD")                                                       ? 10
                                                                                            : 0;
}

} // namespace gmsh
