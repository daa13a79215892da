// MFEM, mesh/nurbs.cpp: NURBSExtension::GenerateOffsets, NURBSPatchMap.
#include "patch_lattice.hpp"

#include "../element/index.hpp"
#include "../element/space.hpp"
#include "../grid_curve.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace elvis_mfem {

namespace {

/** Inner points in a direction. */
int n_inner(const LatticeSize& size, std::size_t axis) { return size[axis] - 2; }

/** The axis along which two vertices of a reference element differ. */
std::size_t axis_between(Geometry geometry, int from, int to) {
    const auto corners = vertices(geometry);
    std::size_t axis = 0;
    while (corners[index(from)][axis] == corners[index(to)][axis]) {
        ++axis;
    }
    return axis;
}

class Numbering {
public:
    Numbering(const Mesh& patches, std::span<const std::array<std::int32_t, 2>> edges, std::span<const LatticeSize> sizes)
        : m_patches(patches), m_sizes(sizes), m_topology(patches) {
        for (std::size_t edge = 0; edge < edges.size(); ++edge) {
            m_edges.emplace(std::minmax(edges[edge][0], edges[edge][1]), edge);
        }
        std::vector<int> of_edge(edges.size(), -1);
        std::vector<std::array<int, 2>> of_face(m_topology.face_corners().size(), {-1, -1});
        for (std::size_t patch = 0; patch < patches.elements.size(); ++patch) {
            count_edges(patch, of_edge);
            count_faces(patch, of_face);
        }
        m_next = patches.n_vertices;
        for (int n : of_edge) {
            m_first_of_edge.push_back(m_next);
            m_next += index(std::max(0, n));
        }
        for (const auto& [n, m] : of_face) {
            m_first_of_face.push_back(m_next);
            m_next += index(n) * index(m);
        }
        m_face_sizes = std::move(of_face);
    }

    PatchLattices operator()() {
        PatchLattices result;
        for (std::size_t patch = 0; patch < m_sizes.size(); ++patch) {
            const LatticeSize& size = m_sizes[patch];
            std::vector<std::int32_t>& numbers = result.numbers.emplace_back();
            for (int k = 0; k < size[2]; ++k) {
                for (int j = 0; j < size[1]; ++j) {
                    for (int i = 0; i < size[0]; ++i) {
                        numbers.push_back(static_cast<std::int32_t>(number(patch, {i, j, k})));
                    }
                }
            }
            std::size_t n_inside = 1;
            for (std::size_t axis = 0; axis < n_axes(); ++axis) {
                n_inside *= index(n_inner(size, axis));
            }
            m_next += n_inside;
        }
        result.n_numbers = m_next;
        return result;
    }

private:
    std::size_t n_axes() const { return index(m_patches.dimension); }
    const MeshElement& patch_at(std::size_t patch) const { return m_patches.elements[patch]; }
    std::int32_t vertex(std::size_t patch, int corner) const { return patch_at(patch).vertices[index(corner)]; }

    std::size_t edge_of(std::size_t patch, const std::array<int, 2>& ends) const {
        const auto found = m_edges.find(std::minmax(vertex(patch, ends[0]), vertex(patch, ends[1])));
        if (found == m_edges.end()) {
            throw std::invalid_argument("patch " + std::to_string(patch) + " has an edge that is not among the edges");
        }
        return found->second;
    }

    void count_edges(std::size_t patch, std::vector<int>& of_edge) const {
        const Geometry geometry = patch_at(patch).geometry;
        for (const auto& ends : edges(geometry)) {
            int& count = of_edge[edge_of(patch, ends)];
            const int here = n_inner(m_sizes[patch], axis_between(geometry, ends[0], ends[1]));
            if (count >= 0 && count != here) {
                throw std::invalid_argument("patch " + std::to_string(patch) +
                                            " has other knots along an edge than its neighbour");
            }
            count = here;
        }
    }

    std::array<int, 2> face_size(std::size_t patch, const FaceVertices& face) const {
        const Geometry geometry = patch_at(patch).geometry;
        return {n_inner(m_sizes[patch], axis_between(geometry, face[0], face[1])),
                n_inner(m_sizes[patch], axis_between(geometry, face[0], face[3]))};
    }

    void count_faces(std::size_t patch, std::vector<std::array<int, 2>>& of_face) const {
        const auto shared = m_topology.faces(patch);
        for (std::size_t face = 0; face < shared.size(); ++face) {
            auto& count = of_face[shared[face].index];
            // Edges agree already: the first patch speaks for all.
            if (count[0] < 0) {
                count = face_size(patch, faces(patch_at(patch).geometry)[face]);
            }
        }
    }

    /** Whether a vertex of the reference element has the point's place in all directions in which it is at an end. */
    bool is_at(std::size_t patch, const Cell& at, int corner) const {
        const Point& place = vertices(patch_at(patch).geometry)[index(corner)];
        for (std::size_t axis = 0; axis < n_axes(); ++axis) {
            const int last = m_sizes[patch][axis] - 1;
            const bool is_inner = at[axis] > 0 && at[axis] < last;
            if (!is_inner && (at[axis] == 0 ? 0 : 1) != static_cast<int>(place[axis])) {
                return false;
            }
        }
        return true;
    }

    /** Inner points that lie between the vertex `from` and the point, in the direction of `to`. */
    int distance(std::size_t patch, const Cell& at, int from, int to) const {
        const Geometry geometry = patch_at(patch).geometry;
        const std::size_t axis = axis_between(geometry, from, to);
        return vertices(geometry)[index(from)][axis] == 0 ? at[axis] - 1 : n_inner(m_sizes[patch], axis) - at[axis];
    }

    std::size_t number(std::size_t patch, const Cell& at) const {
        std::size_t n_free = 0;
        for (std::size_t axis = 0; axis < n_axes(); ++axis) {
            n_free += at[axis] > 0 && at[axis] < m_sizes[patch][axis] - 1 ? 1 : 0;
        }
        return n_free == 0         ? vertex_number(patch, at)
               : n_free == 1       ? edge_number(patch, at)
               : n_free < n_axes() ? face_number(patch, at)
                                   : inner_number(patch, at);
    }

    std::size_t vertex_number(std::size_t patch, const Cell& at) const {
        int corner = 0;
        while (!is_at(patch, at, corner)) {
            ++corner;
        }
        return static_cast<std::size_t>(vertex(patch, corner));
    }

    std::size_t edge_number(std::size_t patch, const Cell& at) const {
        auto ends = *std::ranges::find_if(edges(patch_at(patch).geometry), [&](const std::array<int, 2>& edge) {
            return is_at(patch, at, edge[0]) && is_at(patch, at, edge[1]);
        });
        const std::size_t edge = edge_of(patch, ends);
        if (vertex(patch, ends[0]) > vertex(patch, ends[1])) {
            std::swap(ends[0], ends[1]);
        }
        return m_first_of_edge[edge] + index(distance(patch, at, ends[0], ends[1]));
    }

    std::size_t face_number(std::size_t patch, const Cell& at) const {
        const auto all = faces(patch_at(patch).geometry);
        const auto found = std::ranges::find_if(all, [&](const FaceVertices& face) {
            return std::ranges::all_of(face, [&](int corner) { return is_at(patch, at, corner); });
        });
        const Topology::Face& shared = m_topology.faces(patch)[static_cast<std::size_t>(found - all.begin())];
        // The face's own first corner and its neighbours, among the corners of the face here.
        const int place = shared.orientation / 2;
        const bool is_forward = shared.orientation % 2 == 1;
        const auto own = [&](int i) { return (*found)[index(is_forward ? (i - place + 4) % 4 : (place - i + 4) % 4)]; };
        const int s = distance(patch, at, own(0), own(1)), t = distance(patch, at, own(0), own(3));
        return m_first_of_face[shared.index] + index(s) + index(m_face_sizes[shared.index][0]) * index(t);
    }

    std::size_t inner_number(std::size_t patch, const Cell& at) const {
        const LatticeSize& size = m_sizes[patch];
        const std::size_t third = n_axes() == 3 ? index(at[2] - 1) : 0;
        return m_next + index(at[0] - 1) + index(n_inner(size, 0)) * (index(at[1] - 1) + index(n_inner(size, 1)) * third);
    }

    const Mesh& m_patches;
    std::span<const LatticeSize> m_sizes;
    Topology m_topology;
    std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> m_edges;
    std::vector<std::size_t> m_first_of_edge;
    std::vector<std::size_t> m_first_of_face;
    std::vector<std::array<int, 2>> m_face_sizes;
    /** First number that is not taken. */
    std::size_t m_next = 0;
};

} // namespace

PatchLattices number_lattices(const Mesh& patches, std::span<const std::array<std::int32_t, 2>> edges,
                              std::span<const LatticeSize> sizes) {
    return Numbering(patches, edges, sizes)();
}

} // namespace elvis_mfem
