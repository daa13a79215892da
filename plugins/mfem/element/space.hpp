/**
 * @file space.hpp
 * Global degrees of freedom: which of them belong to an element, and with which signs.
 *
 * MFEM numbers those of vertices first, then of edges, faces and interiors. Edges and faces are numbered as the elements meet
 * them; an edge points from its lower to its higher vertex, a face has the order of vertices of the first element that meets
 * it.
 */
#pragma once

#include "../collection.hpp"
#include "../mesh.hpp"

#include <span>
#include <vector>

namespace elvis_mfem {

/** Edges and faces of a mesh. Immutable. */
class Topology {
public:
    /** Throws std::invalid_argument if an edge or face has a vertex twice (periodic meshes of one or two elements). */
    explicit Topology(const Mesh& mesh);

    struct Edge {
        std::uint32_t index;
        bool is_reversed;
    };
    struct Face {
        std::uint32_t index;
        /** 2 * (place of the local first vertex in the face's own order) + (whether the two turn the same way). */
        std::uint8_t orientation;
    };

    std::span<const Edge> edges(std::size_t element) const;
    std::span<const Face> faces(std::size_t element) const;
    std::size_t n_edges() const { return m_n_edges; }
    /** Corners of each face. */
    const std::vector<std::uint8_t>& face_corners() const { return m_face_corners; }

private:
    std::size_t m_n_edges = 0;
    std::vector<std::uint8_t> m_face_corners;
    std::vector<Edge> m_edges;
    std::vector<Face> m_faces;
    std::vector<std::size_t> m_first_edge;
    std::vector<std::size_t> m_first_face;
};

/** The degrees of freedom of a collection on a mesh. Immutable. */
class Space {
public:
    /** `topology` may be null if needs_topology() is false; mesh and topology must outlive the space. */
    Space(const Collection& collection, const Mesh& mesh, const Topology* topology);

    static bool needs_topology(const Collection& collection);

    /** Of the whole mesh. */
    std::size_t n_dofs() const { return m_n_dofs; }

    /** Calls visit(local dof, global dof, factor); the factors' products with values add up in each local dof. */
    template <class Visit> void for_terms(std::size_t element, Visit&& visit) const;

private:
    /** Local dofs of a face as combinations of the face's own. */
    struct FaceTerm {
        std::uint32_t local;
        std::uint32_t global;
        double factor;
    };
    using FaceMap = std::vector<FaceTerm>;
    static FaceMap make_face_map(const Collection& collection, int n_corners, int orientation);

    const Mesh& m_mesh;
    const Topology* m_topology;
    std::size_t m_per_vertex = 0;
    std::size_t m_per_edge = 0;
    /** By corners: 3 and 4. */
    std::array<std::size_t, 5> m_per_face{};
    /** By geometry. */
    std::array<std::size_t, 8> m_per_interior{};
    double m_reversed_edge_factor = 1;
    std::array<std::vector<FaceMap>, 5> m_face_maps;
    std::size_t m_first_edge_dof = 0;
    std::vector<std::size_t> m_first_face_dof;
    std::vector<std::size_t> m_first_interior_dof;
    std::size_t m_n_dofs = 0;
};

template <class Visit> void Space::for_terms(std::size_t element, Visit&& visit) const {
    const MeshElement& shape = m_mesh.elements[element];
    std::size_t local = 0;
    if (m_per_vertex > 0) {
        for (std::size_t corner = 0; corner < vertices(shape.geometry).size(); ++corner) {
            visit(local++, static_cast<std::size_t>(shape.vertices[corner]), 1.0);
        }
    }
    if (m_topology != nullptr) {
        for (const Topology::Edge& edge : m_topology->edges(element)) {
            const std::size_t first = m_first_edge_dof + edge.index * m_per_edge;
            for (std::size_t i = 0; i < m_per_edge; ++i) {
                visit(local++, first + (edge.is_reversed ? m_per_edge - 1 - i : i),
                      edge.is_reversed ? m_reversed_edge_factor : 1.0);
            }
        }
        for (const Topology::Face& face : m_topology->faces(element)) {
            const std::size_t n_corners = m_topology->face_corners()[face.index];
            const std::size_t first = m_first_face_dof[face.index];
            for (const FaceTerm& term : m_face_maps[n_corners][face.orientation]) {
                visit(local + term.local, first + term.global, term.factor);
            }
            local += m_per_face[n_corners];
        }
    }
    for (std::size_t i = 0; i < m_per_interior[static_cast<std::size_t>(shape.geometry)]; ++i) {
        visit(local++, m_first_interior_dof[element] + i, 1.0);
    }
}

} // namespace elvis_mfem
