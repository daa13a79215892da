#include "space.hpp"

#include "../vertex_key.hpp"
#include "functionals.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <unordered_map>

namespace elvis_mfem {

namespace {

/** `vertices` without places that are -1 must differ. */
VertexKey make_key(const VertexKey& vertices, std::size_t element) {
    VertexKey key = vertices;
    std::ranges::sort(key);
    for (std::size_t i = 1; i < key.size(); ++i) {
        if (key[i] >= 0 && key[i] == key[i - 1]) {
            throw std::invalid_argument("element " + std::to_string(element) + " has an edge or face with a vertex twice");
        }
    }
    return key;
}

struct KnownFace {
    std::uint32_t index;
    VertexKey vertices;
};

/** Throws if the two orders of vertices are not turns or reflections of one another. */
std::uint8_t orientation(const VertexKey& local, const VertexKey& own, std::size_t n, std::size_t element) {
    const auto place = static_cast<std::size_t>(std::find(own.begin(), own.end(), local[0]) - own.begin());
    const bool is_forward = own[(place + 1) % n] == local[1];
    for (std::size_t i = 0; i < n; ++i) {
        if (own[(place + (is_forward ? i : n - i)) % n] != local[i]) {
            throw std::invalid_argument("element " + std::to_string(element) + " shares a face with another order of vertices");
        }
    }
    return static_cast<std::uint8_t>(2 * place + (is_forward ? 1 : 0));
}

} // namespace

Topology::Topology(const Mesh& mesh) {
    std::unordered_map<VertexKey, std::uint32_t, VertexKeyHash> known_edges;
    std::unordered_map<VertexKey, KnownFace, VertexKeyHash> known_faces;
    for (std::size_t index = 0; index < mesh.elements.size(); ++index) {
        const MeshElement& element = mesh.elements[index];
        const auto vertex = [&](int corner) { return corner < 0 ? -1 : element.vertices[static_cast<std::size_t>(corner)]; };
        m_first_edge.push_back(m_edges.size());
        for (const auto& edge : elvis_mfem::edges(element.geometry)) {
            const VertexKey ends{vertex(edge[0]), vertex(edge[1]), -1, -1};
            const auto next = static_cast<std::uint32_t>(known_edges.size());
            const auto found = known_edges.try_emplace(make_key(ends, index), next).first;
            m_edges.push_back({found->second, ends[0] > ends[1]});
        }
        m_first_face.push_back(m_faces.size());
        for (const FaceVertices& face : elvis_mfem::faces(element.geometry)) {
            const VertexKey corners{vertex(face[0]), vertex(face[1]), vertex(face[2]), vertex(face[3])};
            const auto n = static_cast<std::size_t>(n_corners(face));
            const KnownFace next{static_cast<std::uint32_t>(known_faces.size()), corners};
            const auto [found, is_new] = known_faces.try_emplace(make_key(corners, index), next);
            if (is_new) {
                m_face_corners.push_back(static_cast<std::uint8_t>(n));
            }
            m_faces.push_back({found->second.index, orientation(corners, found->second.vertices, n, index)});
        }
    }
    m_first_edge.push_back(m_edges.size());
    m_first_face.push_back(m_faces.size());
    m_n_edges = known_edges.size();
}

std::span<const Topology::Edge> Topology::edges(std::size_t element) const {
    return std::span(m_edges).subspan(m_first_edge[element], m_first_edge[element + 1] - m_first_edge[element]);
}

std::span<const Topology::Face> Topology::faces(std::size_t element) const {
    return std::span(m_faces).subspan(m_first_face[element], m_first_face[element + 1] - m_first_face[element]);
}

bool Space::needs_topology(const Collection& collection) {
    return collection.is_vector() || (collection.family == Family::h1 && collection.order > 1);
}

Space::FaceMap Space::make_face_map(const Collection& collection, int n_corners, int orientation) {
    const std::vector<FrameFunctional> own = face_functionals(collection, n_corners);
    constexpr std::array<std::array<double, 2>, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    constexpr std::array<std::array<double, 2>, 3> triangle{{{0, 0}, {1, 0}, {0, 1}}};
    // The local frame's origin and sides in the face's own parameters.
    const int step = orientation % 2 == 1 ? 1 : n_corners - 1;
    const auto corner = [&](int i) {
        const auto place = static_cast<std::size_t>((orientation / 2 + i * step) % n_corners);
        return n_corners == 3 ? triangle[place] : square[place];
    };
    const auto origin = corner(0), end_s = corner(1), end_t = corner(n_corners - 1);
    const std::array side_s{end_s[0] - origin[0], end_s[1] - origin[1]};
    const std::array side_t{end_t[0] - origin[0], end_t[1] - origin[1]};
    const double turn = side_s[0] * side_t[1] - side_s[1] * side_t[0] > 0 ? 1 : -1;
    FaceMap map;
    for (std::size_t local = 0; local < own.size(); ++local) {
        const FrameFunctional& f = own[local];
        const std::array at{origin[0] + f.s * side_s[0] + f.t * side_t[0], origin[1] + f.s * side_s[1] + f.t * side_t[1]};
        const std::array direction{f.ds * side_s[0] + f.dt * side_t[0], f.ds * side_s[1] + f.dt * side_t[1]};
        for (std::size_t global = 0; global < own.size(); ++global) {
            const FrameFunctional& g = own[global];
            // Nodes of one set are much farther apart than rounding moves them.
            if (std::abs(g.s - at[0]) + std::abs(g.t - at[1]) > 1e-9) {
                continue;
            }
            // Directions of a face's functionals are its two sides: components are factors.
            double factor = 1;
            if (collection.family == Family::nd) {
                factor = g.ds * direction[0] + g.dt * direction[1];
            } else if (collection.family == Family::rt) {
                factor = turn;
            }
            if (factor != 0) {
                map.push_back({static_cast<std::uint32_t>(local), static_cast<std::uint32_t>(global), factor});
            }
        }
    }
    return map;
}

Space::Space(const Collection& collection, const Mesh& mesh, const Topology* topology)
    : m_mesh(mesh), m_topology(needs_topology(collection) ? topology : nullptr) {
    m_per_vertex = collection.family == Family::h1 ? 1 : 0;
    m_per_edge = edge_functionals(collection).size();
    m_reversed_edge_factor = collection.is_vector() ? -1 : 1;
    std::array<bool, 8> is_present{};
    for (const MeshElement& element : mesh.elements) {
        is_present[static_cast<std::size_t>(element.geometry)] = true;
    }
    for (int n_corners : {3, 4}) {
        const auto slot = static_cast<std::size_t>(n_corners);
        m_per_face[slot] = face_functionals(collection, n_corners).size();
        for (int orientation = 0; orientation < 2 * n_corners; ++orientation) {
            m_face_maps[slot].push_back(make_face_map(collection, n_corners, orientation));
        }
    }
    for (Geometry geometry : all_geometries) {
        const auto slot = static_cast<std::size_t>(geometry);
        if (!is_present[slot]) {
            continue;
        }
        std::size_t on_boundary = m_per_vertex * vertices(geometry).size() + m_per_edge * edges(geometry).size();
        for (const FaceVertices& face : faces(geometry)) {
            on_boundary += m_per_face[static_cast<std::size_t>(n_corners(face))];
        }
        m_per_interior[slot] = functionals(collection, geometry).size() - on_boundary;
    }
    m_first_edge_dof = m_per_vertex * mesh.n_vertices;
    m_n_dofs = m_first_edge_dof;
    if (m_topology != nullptr) {
        m_n_dofs += m_per_edge * m_topology->n_edges();
        for (std::uint8_t corners : m_topology->face_corners()) {
            m_first_face_dof.push_back(m_n_dofs);
            m_n_dofs += m_per_face[corners];
        }
    }
    for (const MeshElement& element : mesh.elements) {
        m_first_interior_dof.push_back(m_n_dofs);
        m_n_dofs += m_per_interior[static_cast<std::size_t>(element.geometry)];
    }
}

} // namespace elvis_mfem
