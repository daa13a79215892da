#include <core/extract/mesh_distance.hpp>

#include <core/extract/shape_division.hpp>

#include <algorithm>
#include <bit>
#include <mutex>

namespace elvis {

namespace {

/** Others than those at which cells are judged. */
constexpr std::array<std::array<double, 3>, 4> measured_weights{
    {{0.6, 0.2, 0.2}, {0.2, 0.6, 0.2}, {0.2, 0.2, 0.6}, {0.4, 0.35, 0.25}}};
constexpr std::array<double, 3> measured_shares{0.25, 0.5, 0.8};

Vector3 mean_of(const Triangle3& triangle, const std::array<double, 3>& weights) {
    return plus(plus(scaled(triangle[0], weights[0]), scaled(triangle[1], weights[1])), scaled(triangle[2], weights[2]));
}

Triangle3 reference_triangle(const ElementCells& cells, const CellTriangle& triangle) {
    return {cells.points()[triangle[0]].xi, cells.points()[triangle[1]].xi, cells.points()[triangle[2]].xi};
}

/** Of the triangles of one element. */
class ElementDistance {
public:
    ElementDistance(const SurfaceSampler& sampler, CellMesh& cells, const MergedMesh& mesh, std::uint32_t element)
        : m_sampler(sampler), m_mesh(mesh), m_all(cells), m_cells(cells.elements()[element]) {}

    MeshDistance measure(std::uint32_t first, std::uint32_t end, double most) {
        for (std::uint32_t index = first; index < end; ++index) {
            const Cell& cell = m_cells.cells()[m_mesh.triangles[index].cell];
            // Of several faces of one element each has its own normal.
            if (index == first || cell.local_face != m_face) {
                flush(most);
                m_face = cell.local_face;
                m_element = surface_element(m_cells, cell);
            }
            add(index);
        }
        flush(most);
        return m_distance;
    }

private:
    struct Sample {
        std::uint32_t triangle;
        Vector3 target;
    };
    struct SideSample {
        std::uint32_t triangle, side;
    };

    void add(std::uint32_t index) {
        const MergedTriangle& triangle = m_mesh.triangles[index];
        const Triangle3 flat = flat_triangle(m_cells, triangle.points),
                        reference = reference_triangle(m_cells, triangle.points);
        for (const auto& weights : measured_weights) {
            m_samples.push_back({index, mean_of(flat, weights)});
            m_queries.push_back({mean_of(flat, weights), mean_of(reference, weights)});
        }
        for (std::uint32_t side = 0; side < 3; ++side) {
            const std::uint32_t next = (side + 1) % 3;
            const MergedEdge& edge = m_mesh.edges.at(pair_key(triangle.vertices[side], triangle.vertices[next]));
            const std::uint32_t faces = faces_of_side(m_cells, triangle, side);
            if (edge.n_triangles != 1 || faces == 0) {
                continue;
            }
            for (const double share : measured_shares) {
                CurveQuery query;
                query.xi = plus(scaled(reference[side], 1 - share), scaled(reference[next], share));
                query.face = shape_faces(m_cells.shape()).normals[static_cast<std::size_t>(std::countr_zero(faces))];
                m_side_queries.push_back(query);
                m_sides.push_back({index, side});
            }
        }
    }

    void flush(double most) {
        const std::vector<SurfacePoint> nearest = nearest_on_surface(m_sampler, m_element, m_queries);
        for (std::size_t i = 0; i < nearest.size(); ++i) {
            // What Newton's steps have left.
            const double left = length(minus(predicted_surface(nearest[i]), nearest[i].position));
            note(m_samples[i].triangle, length(minus(nearest[i].position, m_samples[i].target)) + left,
                 distance_to_mesh(m_samples[i].triangle, nearest[i].position) + left, most);
        }
        const std::vector<SurfacePoint> on_rim = points_of_curves(m_sampler, m_element, m_side_queries);
        for (std::size_t i = 0; i < on_rim.size(); ++i) {
            const Triangle3 flat = flat_triangle(m_cells, m_mesh.triangles[m_sides[i].triangle].points);
            const double off = distance_to_segment(on_rim[i].position, flat[m_sides[i].side], flat[(m_sides[i].side + 1) % 3]);
            note(m_sides[i].triangle, 0, off, most);
        }
        m_samples.clear();
        m_queries.clear();
        m_sides.clear();
        m_side_queries.clear();
    }

    void note(std::uint32_t triangle, double to_surface, double to_mesh, double most) {
        m_distance.mesh_to_surface = std::max(m_distance.mesh_to_surface, to_surface);
        m_distance.surface_to_mesh = std::max(m_distance.surface_to_mesh, to_mesh);
        if (to_surface > most || to_mesh > most) {
            m_cells.cells()[m_mesh.triangles[triangle].cell].state = Cell::State::wanted;
        }
    }

    /** From the triangle and those beside it. */
    double distance_to_mesh(std::uint32_t index, const Vector3& position) const {
        const MergedTriangle& triangle = m_mesh.triangles[index];
        double least = distance_to_triangle(position, flat_triangle(m_cells, triangle.points));
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint64_t key = pair_key(triangle.vertices[side], triangle.vertices[(side + 1) % 3]);
            for (const TriangleSide& other : m_mesh.edges.at(key).sides) {
                if (other.triangle != MergedEdge::none && other.triangle != index) {
                    const MergedTriangle& beside = m_mesh.triangles[other.triangle];
                    const ElementCells& its = m_all.elements()[beside.element];
                    least = std::min(least, distance_to_triangle(position, flat_triangle(its, beside.points)));
                }
            }
        }
        return least;
    }

    const SurfaceSampler& m_sampler;
    const MergedMesh& m_mesh;
    const CellMesh& m_all;
    ElementCells& m_cells;
    int m_face = -1;
    SurfaceElement m_element;
    std::vector<Sample> m_samples;
    std::vector<NearestQuery> m_queries;
    std::vector<SideSample> m_sides;
    std::vector<CurveQuery> m_side_queries;
    MeshDistance m_distance;
};

} // namespace

std::uint32_t faces_of_side(const ElementCells& cells, const MergedTriangle& triangle, std::size_t side) {
    const ShapeFaces& faces = shape_faces(cells.shape());
    const std::uint32_t from = triangle.points[side], to = triangle.points[(side + 1) % 3];
    const std::int8_t own = cells.cells()[triangle.cell].local_face;
    const std::uint32_t both = faces.holding(cells.points()[from].xi) & faces.holding(cells.points()[to].xi);
    return own >= 0 ? both & ~(1u << own) : both;
}

MeshDistance measure_distance(const SurfaceSampler& sampler, CellMesh& cells, const MergedMesh& mesh, double most) {
    // Triangles are in the order of elements.
    std::vector<std::uint32_t> first(cells.elements().size() + 1);
    for (const MergedTriangle& triangle : mesh.triangles) {
        ++first[triangle.element + 1];
    }
    for (std::size_t index = 1; index < first.size(); ++index) {
        first[index] += first[index - 1];
    }
    std::mutex mutex;
    MeshDistance all;
    cells.for_each_element("measuring", [&](std::size_t index) {
        if (first[index] == first[index + 1]) {
            return;
        }
        ElementDistance element(sampler, cells, mesh, static_cast<std::uint32_t>(index));
        const MeshDistance found = element.measure(first[index], first[index + 1], most);
        const std::lock_guard lock(mutex);
        all.mesh_to_surface = std::max(all.mesh_to_surface, found.mesh_to_surface);
        all.surface_to_mesh = std::max(all.surface_to_mesh, found.surface_to_mesh);
    });
    return all;
}

} // namespace elvis
