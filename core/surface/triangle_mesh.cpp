#include <core/base/error.hpp>
#include <core/base/infinity.hpp>
#include <core/base/whole_file.hpp>
#include <core/surface/mesh_cursor.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <limits>

namespace elvis {

std::string mesh_ending(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

std::array<double, 6> TriangleMesh::bounds() const {
    std::array<double, 6> box = {infinity, infinity, infinity, -infinity, -infinity, -infinity};
    for (const auto& triangle : triangles) {
        for (const std::uint32_t corner : triangle) {
            for (std::size_t i = 0; i < 3; ++i) {
                box[i] = std::min(box[i], points[corner][i]);
                box[i + 3] = std::max(box[i + 3], points[corner][i]);
            }
        }
    }
    return box;
}

TriangleMesh read_triangle_mesh(const std::string& path) {
    const std::string ending = mesh_ending(path);
    if (ending != ".obj" && ending != ".stl" && ending != ".ply") {
        throw Error(path, "is no mesh of triangles that can be read: its name ends in none of .obj, .stl, .ply");
    }
    const std::string text = read_whole_file(path);
    TriangleMesh mesh = ending == ".obj"   ? read_obj(path, text)
                        : ending == ".stl" ? read_stl(path, text)
                                           : read_ply(path, text);
    if (mesh.triangles.empty()) {
        throw Error(path, "has no triangle");
    }
    mesh.path = path;
    return mesh;
}

} // namespace elvis
