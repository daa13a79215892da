#include "faces.hpp"

#include <algorithm>

namespace nektarpp {

std::vector<elvis_face> find_faces(const Mesh& mesh) {
    struct Side {
        std::int64_t id;
        std::uint64_t element;
        std::int32_t local;
    };
    std::vector<Side> sides;
    for (std::uint64_t element = 0; element < mesh.elements().size(); ++element) {
        const MeshElement& of = mesh.elements()[element];
        for (std::uint32_t side = 0; side < n_sides(of.shape); ++side) {
            sides.push_back({of.sides[side], element, static_cast<std::int32_t>(side)});
        }
    }
    std::ranges::stable_sort(sides, {}, &Side::id);
    std::vector<elvis_face> faces;
    for (std::size_t at = 0; at < sides.size(); ++at) {
        const Side& first = sides[at];
        elvis_face face{sizeof(elvis_face),
                        mesh.elements()[first.element].groups[static_cast<std::size_t>(first.local)],
                        static_cast<std::int64_t>(first.element),
                        ELVIS_NEIGHBOUR_NONE,
                        first.local,
                        -1};
        if (at + 1 < sides.size() && sides[at + 1].id == first.id) {
            ++at;
            if (at + 1 < sides.size() && sides[at + 1].id == first.id) {
                throw elvis::api::Error(ELVIS_ERROR_FORMAT, mesh.path(),
                                        std::string(mesh.dimension() == 3 ? "face " : "edge ") + std::to_string(first.id) +
                                            " belongs to more than two elements");
            }
            face.neighbour = static_cast<std::int64_t>(sides[at].element);
            face.neighbour_local_face = sides[at].local;
        }
        faces.push_back(face);
    }
    return faces;
}

} // namespace nektarpp
