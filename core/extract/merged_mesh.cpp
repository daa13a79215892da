#include <core/extract/merged_mesh.hpp>

#include <utility>

namespace elvis {

namespace {

/** Numbers vertices: those of one edge, or corner, that are at one place. */
class VertexNumbers {
public:
    VertexNumbers(const CellMesh& cells, double distance, MergedMesh& mesh)
        : m_cells(cells), m_distance(distance), m_mesh(mesh) {}

    std::uint32_t of(const LocalPoint& local) {
        const ElementCells& element = m_cells.elements()[local.element];
        const CellPoint& point = element.points()[local.point];
        const bool is_corner = point.id != CellPoint::no_id;
        const std::uint64_t key = is_corner ? pair_key(point.id, point.id)
                                            : pair_key(element.points()[point.ends[0]].id, element.points()[point.ends[1]].id);
        std::vector<std::uint32_t>& there = m_by_key[key];
        for (const std::uint32_t vertex : there) {
            if (length(minus(m_mesh.point(m_cells, vertex).position, point.position)) <= m_distance) {
                return vertex;
            }
        }
        there.push_back(static_cast<std::uint32_t>(m_mesh.vertices.size()));
        m_mesh.vertices.push_back(local);
        return there.back();
    }

private:
    const CellMesh& m_cells;
    double m_distance;
    MergedMesh& m_mesh;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> m_by_key;
};

void add_edges(const MergedTriangle& triangle, std::uint32_t index, MergedMesh& mesh) {
    for (std::uint32_t side = 0; side < 3; ++side) {
        MergedEdge& edge = mesh.edges[pair_key(triangle.vertices[side], triangle.vertices[(side + 1) % 3])];
        if (edge.n_triangles < 2) {
            edge.sides[edge.n_triangles] = {index, side};
        }
        ++edge.n_triangles;
    }
}

} // namespace

MergedMesh merge_triangles(const CellMesh& cells, double distance) {
    MergedMesh mesh;
    VertexNumbers numbers(cells, distance, mesh);
    for (std::uint32_t at = 0; at < cells.elements().size(); ++at) {
        const ElementCells& element = cells.elements()[at];
        std::unordered_map<std::uint32_t, std::uint32_t> known;
        for (std::uint32_t index = 0; index < element.cells().size(); ++index) {
            const Cell& cell = element.cells()[index];
            if (!element.has_surface(cell)) {
                continue;
            }
            for (CellTriangle points : element.triangles(cell)) {
                if (element.is_inverted()) {
                    std::swap(points[1], points[2]);
                }
                MergedTriangle triangle{at, index, points, {}};
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    const auto [place, is_new] = known.try_emplace(points[corner], 0);
                    place->second = is_new ? numbers.of({at, points[corner]}) : place->second;
                    triangle.vertices[corner] = place->second;
                }
                const auto& [a, b, c] = triangle.vertices;
                if (a != b && b != c && c != a) {
                    add_edges(triangle, static_cast<std::uint32_t>(mesh.triangles.size()), mesh);
                    mesh.triangles.push_back(triangle);
                }
            }
        }
    }
    return mesh;
}

} // namespace elvis
