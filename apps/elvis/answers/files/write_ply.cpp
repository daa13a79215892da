#include "binary_file.hpp"
#include "mesh_files.hpp"

#include <algorithm>
#include <cctype>
#include <span>

namespace elvis::commands {

namespace {

/** Properties are single words. */
std::string word_for(const std::string& name) {
    std::string word = name;
    std::ranges::replace_if(
        word, [](unsigned char letter) { return std::isspace(letter) != 0; }, '_');
    return word;
}

std::string ply_header(const extracted& mesh, const std::vector<MeshColumn>& columns, std::size_t n_edges) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment written by ElVis\nelement vertex ";
    text.append(std::to_string(mesh.info.n_vertices)).append("\n");
    for (const char* const name : {"x", "y", "z", "nx", "ny", "nz"}) {
        text.append("property double ").append(name).append("\n");
    }
    text += "property int element\n";
    for (const MeshColumn& column : columns) {
        for (std::uint32_t component = 0; component < column.n_components; ++component) {
            text.append("property double ").append(word_for(column.name));
            if (column.n_components > 1) {
                text.append("_").append(std::to_string(component));
            }
            text += '\n';
        }
    }
    if (mesh.info.n_lines == 0) {
        text.append("element face ").append(std::to_string(mesh.info.n_triangles));
        text += "\nproperty list uchar int vertex_indices\n";
    } else {
        text.append("element edge ").append(std::to_string(n_edges));
        text += "\nproperty int vertex1\nproperty int vertex2\nproperty double isovalue\n";
    }
    return text + "end_header\n";
}

} // namespace

void write_ply(const extracted& mesh, const std::vector<MeshColumn>& columns, const std::string& path) {
    BinaryFile file(path);
    file.text(ply_header(mesh, columns, mesh.line_vertices.size() - mesh.info.n_lines));
    for (std::size_t vertex = 0; vertex < mesh.info.n_vertices; ++vertex) {
        file.numbers<double>(std::span(mesh.positions).subspan(3 * vertex, 3));
        file.numbers<double>(std::span(mesh.normals).subspan(3 * vertex, 3));
        file.number(static_cast<std::int32_t>(mesh.elements[vertex]));
        file.numbers<double>(std::span(mesh.values).subspan(vertex * mesh.info.n_values, mesh.info.n_values));
    }
    for (std::size_t at = 0; at < mesh.triangles.size(); at += 3) {
        file.number(std::uint8_t{3});
        file.numbers<std::int32_t>(std::span(mesh.triangles).subspan(at, 3));
    }
    for (std::size_t line = 0; line < mesh.info.n_lines; ++line) {
        for (std::uint64_t at = mesh.line_first[line]; at + 1 < mesh.line_first[line + 1]; ++at) {
            file.numbers<std::int32_t>(std::span(mesh.line_vertices).subspan(at, 2));
            file.number(mesh.line_values[line]);
        }
    }
    file.commit();
}

} // namespace elvis::commands
