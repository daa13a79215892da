#include "binary_file.hpp"
#include "mesh_files.hpp"

#include <core/base/vector3.hpp>

#include <limits>

namespace elvis::commands {

namespace {

Vector3 vertex_of(const extracted& mesh, std::size_t index) {
    const double* const at = &mesh.positions[3 * std::size_t{mesh.triangles[index]}];
    return {at[0], at[1], at[2]};
}

} // namespace

void write_stl(const extracted& mesh, const std::string& path) {
    if (mesh.info.n_triangles > std::numeric_limits<std::uint32_t>::max()) {
        throw Error(path, "holds at most 4294967295 triangles");
    }
    BinaryFile file(path);
    std::string header = "binary STL by ElVis";
    header.resize(80, ' ');
    file.text(header);
    file.number(static_cast<std::uint32_t>(mesh.info.n_triangles));
    for (std::size_t at = 0; at < mesh.triangles.size(); at += 3) {
        const Vector3 a = vertex_of(mesh, at), b = vertex_of(mesh, at + 1), c = vertex_of(mesh, at + 2);
        const Vector3 area = cross(minus(b, a), minus(c, a));
        const double size = length(area);
        file.numbers<float>(size > 0 ? scaled(area, 1 / size) : Vector3{});
        for (const Vector3& corner : {a, b, c}) {
            file.numbers<float>(corner);
        }
        file.number(std::uint16_t{0});
    }
    file.commit();
}

} // namespace elvis::commands
