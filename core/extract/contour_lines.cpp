#include <core/extract/contour_lines.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace elvis {

namespace {

constexpr std::array<double, 3> compared_shares{0.25, 0.5, 0.8};

/** A contour's way through one triangle. */
struct Segment {
    std::uint32_t triangle = 0;
    std::size_t isovalue = 0;
    /** Sides that it meets. */
    std::array<std::size_t, 2> sides{};
    std::array<SurfacePoint, 2> ends;
    std::array<std::uint32_t, 2> points{};
    /** Of the curve from the segment. */
    double distance = 0;
};

using Values = std::array<double, 3>;

/** At vertices: of the first element, where those of others are the same but for rounding. */
class CornerValues {
public:
    CornerValues(const CellMesh& cells, const MergedMesh& mesh) : m_cells(cells), m_mesh(mesh) {
        constexpr double continuous_values = 1e-9;
        for (std::uint32_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
            m_rounding = std::max(m_rounding, continuous_values * std::abs(mesh.point(cells, vertex).contour.value));
        }
    }
    Values of(const MergedTriangle& triangle) const {
        Values values{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const double own = m_cells.elements()[triangle.element].points()[triangle.points[corner]].contour.value;
            const double shared = m_mesh.point(m_cells, triangle.vertices[corner]).contour.value;
            values[corner] = std::abs(own - shared) <= m_rounding ? shared : own;
        }
        return values;
    }

private:
    const CellMesh& m_cells;
    const MergedMesh& m_mesh;
    double m_rounding = 0;
};

/** Of the triangles first to end - 1, which are of one element. */
std::vector<Segment> segments_of(const SurfaceSampler& sampler, const ElementCells& cells, const MergedMesh& mesh,
                                 const CornerValues& values, const std::vector<double>& isovalues, std::uint32_t first,
                                 std::uint32_t end) {
    std::vector<Segment> segments;
    for (std::uint32_t index = first; index < end; ++index) {
        const MergedTriangle& triangle = mesh.triangles[index];
        const Cell& cell = cells.cells()[triangle.cell];
        const SurfaceElement element = surface_element(cells, cell);
        for (std::size_t k = 0; k < isovalues.size(); ++k) {
            std::vector<CurveQuery> queries;
            Segment segment{index, k, {}, {}, {}, 0};
            for (const SideCrossing& crossing : side_crossings(values.of(triangle), isovalues[k])) {
                segment.sides[queries.size()] = crossing.side;
                queries.push_back(side_query(cells, cell, triangle.points, crossing, isovalues[k]));
            }
            if (queries.empty()) {
                continue;
            }
            const std::vector<SurfacePoint> ends = points_of_curves(sampler, element, queries);
            segment.ends = {ends[0], ends[1]};
            std::vector<CurveQuery> between;
            for (const double share : compared_shares) {
                between.push_back({plus(scaled(ends[0].xi, 1 - share), scaled(ends[1].xi, share)), isovalues[k], std::nullopt});
            }
            for (const SurfacePoint& point : points_of_curves(sampler, element, between)) {
                segment.distance =
                    std::max(segment.distance, distance_to_segment(point.position, ends[0].position, ends[1].position));
            }
            segments.push_back(segment);
        }
    }
    return segments;
}

/** Lines out of segments that share points. */
class LineChain {
public:
    LineChain(const std::vector<Segment>& segments, std::size_t n_points) : m_segments(segments), m_at(n_points) {
        for (std::size_t index = 0; index < segments.size(); ++index) {
            for (const std::uint32_t point : segments[index].points) {
                m_at[point].push_back(index);
            }
        }
        m_is_used.resize(segments.size());
    }

    std::vector<ContourLine> lines(const std::vector<double>& isovalues) {
        std::vector<ContourLine> all;
        // First those that end somewhere, from there.
        for (const bool is_closed : {false, true}) {
            for (std::size_t index = 0; index < m_segments.size(); ++index) {
                const auto& [from, to] = m_segments[index].points;
                const bool starts_here = is_closed || m_at[from].size() != 2 || m_at[to].size() != 2;
                if (!m_is_used[index] && starts_here) {
                    const std::uint32_t start = is_closed || m_at[from].size() != 2 ? from : to;
                    all.push_back({isovalues[m_segments[index].isovalue], follow(start, index)});
                }
            }
        }
        return all;
    }
    std::size_t n_segments_at(std::uint32_t point) const { return m_at[point].size(); }

private:
    std::vector<std::uint32_t> follow(std::uint32_t point, std::size_t segment) {
        std::vector<std::uint32_t> points{point};
        while (true) {
            m_is_used[segment] = true;
            const auto& ends = m_segments[segment].points;
            point = ends[0] == point ? ends[1] : ends[0];
            points.push_back(point);
            const std::vector<std::size_t>& there = m_at[point];
            if (there.size() != 2) {
                return points;
            }
            segment = there[0] == segment ? there[1] : there[0];
            if (m_is_used[segment]) {
                return points;
            }
        }
    }

    const std::vector<Segment>& m_segments;
    std::vector<std::vector<std::size_t>> m_at;
    std::vector<bool> m_is_used;
};

} // namespace

ContourLines contour_lines(const SurfaceSampler& sampler, CellMesh& cells, const MergedMesh& mesh,
                           const std::vector<double>& isovalues, double distance, double most) {
    const CornerValues values(cells, mesh);
    std::vector<std::uint32_t> first(cells.elements().size() + 1);
    for (const MergedTriangle& triangle : mesh.triangles) {
        ++first[triangle.element + 1];
    }
    for (std::size_t index = 1; index < first.size(); ++index) {
        first[index] += first[index - 1];
    }
    std::vector<std::vector<Segment>> found(cells.elements().size());
    cells.for_each_element("following contours", [&](std::size_t index) {
        found[index] = segments_of(sampler, cells.elements()[index], mesh, values, isovalues, first[index], first[index + 1]);
    });

    ContourLines contours;
    std::vector<Segment> segments;
    std::map<std::pair<std::uint64_t, std::size_t>, std::vector<std::uint32_t>> by_side;
    std::vector<bool> is_in_rim;
    for (std::vector<Segment>& of_element : found) {
        for (Segment& segment : of_element) {
            const MergedTriangle& triangle = mesh.triangles[segment.triangle];
            ElementCells& element = cells.elements()[triangle.element];
            contours.distance = std::max(contours.distance, segment.distance);
            if (segment.distance > most) {
                element.cells()[triangle.cell].state = Cell::State::wanted;
            }
            for (std::size_t end = 0; end < 2; ++end) {
                const std::size_t side = segment.sides[end];
                const std::uint64_t key = pair_key(triangle.vertices[side], triangle.vertices[(side + 1) % 3]);
                std::vector<std::uint32_t>& there = by_side[{key, segment.isovalue}];
                const auto same = std::ranges::find_if(there, [&](std::uint32_t point) {
                    return length(minus(contours.points[point].at.position, segment.ends[end].position)) <= distance;
                });
                if (same == there.end()) {
                    there.push_back(static_cast<std::uint32_t>(contours.points.size()));
                    const SurfacePoint& at = segment.ends[end];
                    contours.points.push_back({triangle.element, at, at.world(at.level.slope)});
                    is_in_rim.push_back(mesh.edges.at(key).n_triangles == 1);
                    segment.points[end] = there.back();
                } else {
                    segment.points[end] = *same;
                }
            }
            contours.length += length(minus(segment.ends[0].position, segment.ends[1].position));
            if (segment.points[0] != segment.points[1]) {
                segments.push_back(segment);
            }
        }
    }
    LineChain chain(segments, contours.points.size());
    contours.lines = chain.lines(isovalues);
    for (std::uint32_t point = 0; point < contours.points.size(); ++point) {
        contours.n_open_ends += chain.n_segments_at(point) == 1 && !is_in_rim[point] ? 1 : 0;
    }
    return contours;
}

} // namespace elvis
