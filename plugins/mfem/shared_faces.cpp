#include "shared_faces.hpp"

#include <elvis/native/space.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace elvis_mfem {

namespace {

using Corner = std::array<double, 3>;
/** Of its corners, ascending; those that are missing are infinite. */
using FaceKey = std::array<Corner, 4>;

/** By vertex. */
std::vector<Corner> vertex_positions(const Part& part) {
    std::vector<Corner> positions(part.mesh().n_vertices);
    for (std::size_t element = 0; element < part.mesh().elements.size(); ++element) {
        const MeshElement& source = part.mesh().elements[element];
        const auto native_shape = static_cast<elvis::native::Shape>(shape(source.geometry));
        const auto corners = corner_vertices(source.geometry);
        for (std::size_t corner = 0; corner < corners.size(); ++corner) {
            const elvis::native::Point xi = elvis::native::corner(native_shape, static_cast<int>(corner));
            const std::int32_t vertex = source.vertices[static_cast<std::size_t>(corners[corner])];
            part.mapping().evaluate(element, xi, positions[static_cast<std::size_t>(vertex)].data(), 3);
        }
    }
    return positions;
}

FaceKey key_of(const BoundaryElement& element, const std::vector<Corner>& positions) {
    constexpr double missing = std::numeric_limits<double>::infinity();
    FaceKey key;
    key.fill({missing, missing, missing});
    std::size_t n = 0;
    for (const std::int32_t vertex : element.vertices) {
        if (vertex >= 0) {
            key[n++] = positions[static_cast<std::size_t>(vertex)];
        }
    }
    std::ranges::sort(key);
    return key;
}

} // namespace

std::vector<std::vector<bool>> shared_faces(const std::vector<std::unique_ptr<const Part>>& parts) {
    struct Seen {
        std::size_t part, element;
    };
    std::map<FaceKey, Seen> seen;
    std::vector<std::vector<bool>> shared;
    for (std::size_t part = 0; part < parts.size(); ++part) {
        const std::vector<BoundaryElement>& boundary = parts[part]->mesh().boundary;
        shared.emplace_back(boundary.size(), false);
        if (parts.size() == 1) {
            continue;
        }
        const std::vector<Corner> positions = vertex_positions(*parts[part]);
        for (std::size_t element = 0; element < boundary.size(); ++element) {
            const auto [found, is_new] = seen.try_emplace(key_of(boundary[element], positions), Seen{part, element});
            if (!is_new && found->second.part != part) {
                shared[part][element] = shared[found->second.part][found->second.element] = true;
            }
        }
    }
    return shared;
}

} // namespace elvis_mfem
