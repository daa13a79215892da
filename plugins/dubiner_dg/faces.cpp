#include "faces.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <map>

namespace elvis::dubiner {

namespace {

/** Corners of local faces: elvis/element.h. */
constexpr std::size_t face_corners[4][3] = {{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}};

std::string named(const Triangle& face) {
    return std::to_string(face[0]) + " " + std::to_string(face[1]) + " " + std::to_string(face[2]);
}

} // namespace

std::vector<elvis_face> find_faces(const File& file, const std::string& path) {
    std::vector<elvis_face> faces;
    std::map<Triangle, std::size_t> by_vertices;
    for (std::size_t element = 0; element < file.elements.size(); ++element) {
        for (int local = 0; local < 4; ++local) {
            Triangle vertices;
            for (std::size_t i = 0; i < 3; ++i) {
                vertices[i] = file.elements[element].vertices[face_corners[local][i]];
            }
            std::sort(vertices.begin(), vertices.end());
            const auto [found, is_new] = by_vertices.try_emplace(vertices, faces.size());
            if (is_new) {
                faces.push_back({sizeof(elvis_face), ELVIS_GROUP_NONE, static_cast<std::int64_t>(element), ELVIS_NEIGHBOUR_NONE,
                                 local, -1});
                continue;
            }
            elvis_face& face = faces[found->second];
            if (face.neighbour != ELVIS_NEIGHBOUR_NONE) {
                throw api::Error(ELVIS_ERROR_FORMAT, path,
                                 "elements " + std::to_string(face.element) + ", " + std::to_string(face.neighbour) + " and " +
                                     std::to_string(element) + " share the face with vertices " + named(vertices));
            }
            face.neighbour = static_cast<std::int64_t>(element);
            face.neighbour_local_face = local;
        }
    }
    for (const BoundaryFace& boundary : file.boundary) {
        const auto found = by_vertices.find(boundary.vertices);
        if (found == by_vertices.end()) {
            throw api::Error(ELVIS_ERROR_FORMAT, path,
                             "no element has the boundary face with vertices " + named(boundary.vertices));
        }
        faces[found->second].group = static_cast<std::int32_t>(boundary.group);
    }
    return faces;
}

} // namespace elvis::dubiner
