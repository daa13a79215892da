#include "binary_file.hpp"
#include "mesh_files.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

namespace elvis::commands {

namespace {

using nlohmann::ordered_json;

/** Numbers of glTF's tables of types. */
constexpr int type_float = 5126, type_unsigned_int = 5125;
constexpr int target_vertices = 34962, target_indices = 34963;
constexpr int mode_lines = 1, mode_triangles = 4;

/** The binary part and what the text part says of it. */
class GltfBuffer {
public:
    /** Returns the accessor's number. */
    template <class Number>
    int add(const std::vector<Number>& numbers, int component_type, const std::string& type, std::size_t n_components,
            int target, bool with_bounds) {
        views.push_back(
            {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", numbers.size() * sizeof(Number)}, {"target", target}});
        const auto* const first = reinterpret_cast<const char*>(numbers.data());
        bytes.append(first, numbers.size() * sizeof(Number));
        ordered_json accessor = {{"bufferView", views.size() - 1},
                                 {"componentType", component_type},
                                 {"count", numbers.size() / n_components},
                                 {"type", type}};
        if (with_bounds) {
            for (std::size_t component = 0; component < n_components; ++component) {
                Number least = std::numeric_limits<Number>::max(), most = std::numeric_limits<Number>::lowest();
                for (std::size_t i = component; i < numbers.size(); i += n_components) {
                    least = std::min(least, numbers[i]);
                    most = std::max(most, numbers[i]);
                }
                accessor["min"].push_back(least);
                accessor["max"].push_back(most);
            }
        }
        accessors.push_back(accessor);
        return static_cast<int>(accessors.size() - 1);
    }

    std::string bytes;
    ordered_json views = ordered_json::array(), accessors = ordered_json::array();
};

/** The format's y is up: a turn about x. */
std::vector<float> turned(const std::vector<double>& vectors) {
    std::vector<float> all(vectors.size());
    for (std::size_t i = 0; i < vectors.size(); i += 3) {
        all[i] = static_cast<float>(vectors[i]);
        all[i + 1] = static_cast<float>(vectors[i + 2]);
        all[i + 2] = static_cast<float>(-vectors[i + 1]);
    }
    return all;
}

/** Attributes of programs' own begin with an underscore, and are upper case by custom. */
std::string attribute_name(const std::string& name) {
    std::string word = "_";
    for (const char letter : name) {
        const auto byte = static_cast<unsigned char>(letter);
        word += std::isalnum(byte) != 0 ? static_cast<char>(std::toupper(byte)) : '_';
    }
    return word;
}

void add_values(const extracted& mesh, const std::vector<MeshColumn>& columns, GltfBuffer& buffer, ordered_json& attributes) {
    constexpr std::array<const char*, 4> types{"SCALAR", "VEC2", "VEC3", "VEC4"};
    for (const MeshColumn& column : columns) {
        // More than four components have no type: each stands for itself.
        const std::size_t n = column.n_components <= types.size() ? column.n_components : 1;
        for (std::size_t first = 0; first < column.n_components; first += n) {
            std::vector<float> values;
            for (std::size_t vertex = 0; vertex < mesh.info.n_vertices; ++vertex) {
                for (std::size_t k = 0; k < n; ++k) {
                    values.push_back(static_cast<float>(mesh.values[vertex * mesh.info.n_values + column.first + first + k]));
                }
            }
            std::string name = attribute_name(column.name);
            if (n < column.n_components) {
                name.append("_").append(std::to_string(first));
            }
            attributes[name] = buffer.add(values, type_float, types[n - 1], n, target_vertices, false);
        }
    }
}

std::vector<std::uint32_t> line_ends(const extracted& mesh) {
    std::vector<std::uint32_t> ends;
    for (std::size_t line = 0; line < mesh.info.n_lines; ++line) {
        for (std::uint64_t at = mesh.line_first[line]; at + 1 < mesh.line_first[line + 1]; ++at) {
            ends.insert(ends.end(), {mesh.line_vertices[at], mesh.line_vertices[at + 1]});
        }
    }
    return ends;
}

} // namespace

void write_glb(const extracted& mesh, const std::vector<MeshColumn>& columns, const std::string& path) {
    ordered_json document = {{"asset", {{"version", "2.0"}, {"generator", "ElVis"}}}};
    GltfBuffer buffer;
    if (mesh.info.n_vertices > 0) {
        ordered_json attributes;
        attributes["POSITION"] = buffer.add(turned(mesh.positions), type_float, "VEC3", 3, target_vertices, true);
        attributes["NORMAL"] = buffer.add(turned(mesh.normals), type_float, "VEC3", 3, target_vertices, false);
        add_values(mesh, columns, buffer, attributes);
        const bool has_lines = mesh.info.n_lines > 0;
        const int indices =
            buffer.add(has_lines ? line_ends(mesh) : mesh.triangles, type_unsigned_int, "SCALAR", 1, target_indices, false);
        document["scene"] = 0;
        document["scenes"] = {{{"nodes", {0}}}};
        document["nodes"] = {{{"mesh", 0}}};
        document["materials"] = {{{"doubleSided", true}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}}};
        document["meshes"] = {{{"primitives",
                                {{{"attributes", attributes},
                                  {"indices", indices},
                                  {"material", 0},
                                  {"mode", has_lines ? mode_lines : mode_triangles}}}}}};
        buffer.bytes.resize((buffer.bytes.size() + 3) / 4 * 4, '\0');
        document["buffers"] = {{{"byteLength", buffer.bytes.size()}}};
        document["bufferViews"] = buffer.views;
        document["accessors"] = buffer.accessors;
    }
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t size = 12 + 8 + text.size() + (buffer.bytes.empty() ? 0 : 8 + buffer.bytes.size());
    if (size > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(path, "would be larger than the 4 GiB of the format; .ply and .vtp have no such limit");
    }
    BinaryFile file(path);
    file.text("glTF");
    file.number(std::uint32_t{2});
    file.number(static_cast<std::uint32_t>(size));
    file.number(static_cast<std::uint32_t>(text.size()));
    file.text("JSON");
    file.text(text);
    if (!buffer.bytes.empty()) {
        file.number(static_cast<std::uint32_t>(buffer.bytes.size()));
        file.text(std::string_view("BIN\0", 4));
        file.text(buffer.bytes);
    }
    file.commit();
}

} // namespace elvis::commands
