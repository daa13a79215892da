#include <core/extract/cell_judge.hpp>

#include <core/extract/shape_division.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace elvis {

namespace {

/** Looking into more parts of an element than this, bounds of the whole are too coarse: parts are judged by what they show. */
constexpr std::size_t most_bounded_parts = 300000;
/** Of the tolerance: what linear models may say, so that what is measured afterwards is within it. */
constexpr double model_share = 0.8;

/** Of the tolerance: parts of the surface that come through a face by less may be missing. */
constexpr double thin_share = 0.5;

/** Where a triangle is compared with the surface: barycentric coordinates. */
constexpr std::array<std::array<double, 3>, 7> sample_weights{{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                               {0.5, 0.5, 0},
                                                               {0, 0.5, 0.5},
                                                               {0.5, 0, 0.5},
                                                               {2.0 / 3, 1.0 / 6, 1.0 / 6},
                                                               {1.0 / 6, 2.0 / 3, 1.0 / 6},
                                                               {1.0 / 6, 1.0 / 6, 2.0 / 3}}};

/** What corners of a cell have, side by side. */
struct CornerData {
    std::vector<Vector3> xi, slopes;
    std::vector<double> values;

    CornerData(const ElementCells& cells, std::span<const std::uint32_t> corners) {
        for (const std::uint32_t corner : corners) {
            const CellPoint& point = cells.points()[corner];
            xi.push_back(point.xi);
            slopes.push_back(point.level.slope);
            values.push_back(point.level.value);
        }
    }
    SimplexFunction function(double bend) const { return {xi, values, slopes, bend}; }
};

std::span<const std::uint32_t> corners_of(const Cell& cell) { return std::span(cell.corners).first(cell.n_corners); }

/** Of a tetrahedron or triangle. */
struct LongestSide {
    double length = 0;
    std::uint32_t from = 0, to = 0;

    LongestSide(const ElementCells& cells, std::span<const std::uint32_t> corners) {
        for (std::size_t i = 0; i < corners.size(); ++i) {
            for (std::size_t j = i + 1; j < corners.size(); ++j) {
                const double side =
                    elvis::length(minus(cells.points()[corners[i]].position, cells.points()[corners[j]].position));
                if (side >= length) {
                    length = side;
                    from = corners[i];
                    to = corners[j];
                }
            }
        }
    }
};

/** Which side of its triangles the points of a cell are on. */
class CellSides {
public:
    CellSides(const ElementCells& cells, const Cell& cell) : m_cells(cells), m_cell(cell) {
        for (const CellTriangle& triangle : cells.triangles(cell)) {
            const Triangle3 flat = flat_triangle(cells, triangle);
            const Vector3 area = cross(minus(flat[1], flat[0]), minus(flat[2], flat[0]));
            m_normal = plus(m_normal, cells.is_inverted() ? scaled(area, -1) : area);
            m_middle = flat[0];
        }
        // Triangles without area have no side of their own.
        m_has_plane = std::ranges::all_of(cell.corners, [&](std::uint32_t corner) {
            return elvis::is_above(cells.points()[corner]) == is_above_plane(cells.points()[corner]);
        });
    }

    bool is_above(const CellPoint& point) const { return m_has_plane ? is_above_plane(point) : linear_level(point) >= 0; }

private:
    bool is_above_plane(const CellPoint& point) const { return dot(minus(point.position, m_middle), m_normal) >= 0; }
    /** Between the corners. */
    double linear_level(const CellPoint& point) const {
        const auto corner = [&](std::size_t i) -> const CellPoint& { return m_cells.points()[m_cell.corners[i]]; };
        const Vector3 &origin = corner(0).xi, a = minus(corner(1).xi, origin), b = minus(corner(2).xi, origin),
                      c = minus(corner(3).xi, origin), way = minus(point.xi, origin);
        const double volume = dot(a, cross(b, c));
        const std::array<double, 3> shares{dot(way, cross(b, c)) / volume, dot(a, cross(way, c)) / volume,
                                           dot(a, cross(b, way)) / volume};
        double level = corner(0).level.value;
        for (std::size_t i = 0; i < 3; ++i) {
            level += shares[i] * (corner(i + 1).level.value - corner(0).level.value);
        }
        return level;
    }

    const ElementCells& m_cells;
    const Cell& m_cell;
    Vector3 m_normal{}, m_middle{};
    bool m_has_plane = false;
};

std::uint32_t faces_holding(const ElementCells& cells, std::uint32_t point) {
    return shape_faces(cells.shape()).holding(cells.points()[point].xi);
}

} // namespace

SurfaceElement surface_element(const ElementCells& cells, const Cell& cell) {
    Vector3 normal{};
    if (cell.n_corners == 3) {
        normal = cell.local_face < 0 ? Vector3{0, 0, 1}
                                     : shape_faces(cells.shape()).normals[static_cast<std::size_t>(cell.local_face)];
    }
    return {cells.element(), cells.shape(), normal};
}

Triangle3 flat_triangle(const ElementCells& cells, const CellTriangle& triangle) {
    const std::vector<CellPoint>& points = cells.points();
    return {points[triangle[0]].position, points[triangle[1]].position, points[triangle[2]].position};
}

std::vector<SideCrossing> side_crossings(const std::array<double, 3>& values, double isovalue) {
    std::vector<SideCrossing> crossings;
    for (std::size_t side = 0; side < 3; ++side) {
        const double from = values[side] - isovalue, to = values[(side + 1) % 3] - isovalue;
        if ((from >= 0) != (to >= 0)) {
            crossings.push_back({side, from / (from - to)});
        }
    }
    return crossings;
}

CurveQuery side_query(const ElementCells& cells, const Cell& cell, const CellTriangle& triangle, const SideCrossing& crossing,
                      double isovalue) {
    const std::uint32_t from = triangle[crossing.side], to = triangle[(crossing.side + 1) % 3];
    CurveQuery query;
    query.xi = plus(scaled(cells.points()[from].xi, 1 - crossing.share), scaled(cells.points()[to].xi, crossing.share));
    query.contour = isovalue;
    std::uint32_t faces = faces_holding(cells, from) & faces_holding(cells, to);
    faces &= cell.local_face >= 0 ? ~(1u << cell.local_face) : ~0u;
    if (faces != 0) {
        query.face = shape_faces(cells.shape()).normals[static_cast<std::size_t>(std::countr_zero(faces))];
    }
    return query;
}

bool CellJudge::are_faces_clear(const ElementCells& cells, Corners corners, double bend) const {
    const ShapeFaces& faces = shape_faces(cells.shape());
    const auto is_side_clear = [&](Corners side) {
        std::uint32_t holding = ~0u;
        for (const std::uint32_t corner : side) {
            holding &= faces_holding(cells, corner);
        }
        const std::size_t n_faces = side.size() == 3 ? 1 : 2;
        if (static_cast<std::size_t>(std::popcount(holding)) < n_faces) {
            return true;
        }
        const CornerData data(cells, side);
        const SimplexFunction function = data.function(bend);
        double steepness = HUGE_VAL;
        for (const std::uint32_t corner : side) {
            steepness = std::min(steepness, cells.points()[corner].steepness);
        }
        return function.is_nowhere_zero() || function.largest() <= thin_share * m_tolerance * steepness ||
               (side.size() == 3
                    ? function.is_monotone_in_plane(faces.normals[static_cast<std::size_t>(std::countr_zero(holding))])
                    : function.is_monotone_along(minus(data.xi[1], data.xi[0])));
    };
    for (std::size_t i = 0; i < 4; ++i) {
        const std::array<std::uint32_t, 3> face{corners[i], corners[(i + 1) % 4], corners[(i + 2) % 4]};
        if (!is_side_clear(face)) {
            return false;
        }
        for (std::size_t j = i + 1; j < 4; ++j) {
            const std::array<std::uint32_t, 2> edge{corners[i], corners[j]};
            if (!is_side_clear(edge)) {
                return false;
            }
        }
    }
    return true;
}

bool CellJudge::is_clear(const ElementCells& cells, Corners corners, double bend) const {
    const CornerData data(cells, corners);
    const SimplexFunction function = data.function(bend);
    return function.is_nowhere_zero() || (function.is_monotone() && are_faces_clear(cells, corners, bend));
}

/** A point of a cell is on another side than the cell's triangles say, and not because these are off by the tolerance. */
bool CellJudge::is_unexpected(const ElementCells& cells, const Cell& cell, std::uint32_t point) const {
    const CellPoint& here = cells.points()[point];
    // Parts of the surface that come through a face by less than this are thinner than the tolerance.
    if (std::abs(here.level.value) <= thin_share * m_tolerance * here.steepness) {
        return false;
    }
    if (!cells.has_surface(cell)) {
        return is_above(here) != is_above(cells.points()[cell.corners[0]]);
    }
    double distance = HUGE_VAL;
    for (const CellTriangle& triangle : cells.triangles(cell)) {
        distance = std::min(distance, distance_to_triangle(here.position, flat_triangle(cells, triangle)));
    }
    return distance > m_tolerance && CellSides(cells, cell).is_above(here) != is_above(here);
}

/**
 * A closed part of the surface that no corner shows encloses a place where the level is extreme; one that ends at faces of the
 * element, a place where it is extreme among those of the faces or edges. None is where it grows along some direction. Cells
 * are looked into by halving them again and again until all parts are clear; the mesh stays as it is, unless a point of them
 * is on an unexpected side.
 */
void CellJudge::look_for_hidden_parts(ElementCells& cells, const std::vector<std::size_t>& chosen, const Bend& bend,
                                      bool& has_sampled) const {
    struct Part {
        std::array<std::uint32_t, 4> corners;
        std::size_t cell;
    };
    std::vector<Part> parts, halves;
    std::vector<std::uint32_t> middles;
    for (const std::size_t index : chosen) {
        if (cells.cells()[index].n_corners == 4) {
            parts.push_back({cells.cells()[index].corners, index});
        }
    }
    has_sampled = has_sampled || (!parts.empty() && !bend.is_certified);
    for (std::size_t n_parts = 0; !parts.empty(); n_parts += parts.size()) {
        halves.clear();
        middles.clear();
        for (const Part& part : parts) {
            Cell& cell = cells.cells()[part.cell];
            double most = bend.level;
            if (n_parts > most_bounded_parts) {
                has_sampled = true;
                const CornerData data(cells, part.corners);
                most = std::min(most, local_bend(data.xi, data.slopes));
            }
            if (cell.state == Cell::State::wanted || is_clear(cells, part.corners, most)) {
                continue;
            }
            const LongestSide side(cells, part.corners);
            if (!(side.length > m_tolerance)) {
                cell.is_undecided = true;
                continue;
            }
            middles.push_back(cells.middle(side.from, side.to));
            for (const std::uint32_t replaced : {side.from, side.to}) {
                halves.push_back(part);
                std::ranges::replace(halves.back().corners, replaced, middles.back());
            }
        }
        cells.evaluate_new(m_sampler);
        for (std::size_t index = 0; index < middles.size(); ++index) {
            Cell& cell = cells.cells()[halves[2 * index].cell];
            if (cell.state != Cell::State::wanted && is_unexpected(cells, cell, middles[index])) {
                cell.state = Cell::State::wanted;
            }
        }
        parts.swap(halves);
    }
}

bool CellJudge::are_contours_clear(const ElementCells& cells, const CellTriangle& triangle, double bend) const {
    std::vector<Vector3> xi, slopes;
    std::vector<double> values;
    for (const std::uint32_t corner : triangle) {
        const CellPoint& point = cells.points()[corner];
        xi.push_back(point.xi);
        slopes.push_back(point.contour.slope);
        values.push_back(point.contour.value);
    }
    const Vector3 area = cross(minus(xi[1], xi[0]), minus(xi[2], xi[0]));
    const double size = length(area);
    for (const double isovalue : m_contours) {
        std::vector<double> off = values;
        for (double& value : off) {
            value -= isovalue;
        }
        const SimplexFunction function(xi, off, slopes, bend);
        if (!function.is_nowhere_zero() && size > 0 && !function.is_monotone_in_plane(scaled(area, 1 / size))) {
            return false;
        }
    }
    return true;
}

bool CellJudge::are_contours_fine(const ElementCells& cells, const Cell& cell, const CellTriangle& triangle) const {
    const SurfaceElement element = surface_element(cells, cell);
    std::array<double, 3> values{};
    std::ranges::transform(triangle, values.begin(),
                           [&](std::uint32_t corner) { return cells.points()[corner].contour.value; });
    for (const double isovalue : m_contours) {
        std::vector<CurveQuery> queries;
        for (const SideCrossing& crossing : side_crossings(values, isovalue)) {
            queries.push_back(side_query(cells, cell, triangle, crossing, isovalue));
        }
        if (queries.empty()) {
            continue;
        }
        const std::vector<SurfacePoint> ends = points_of_curves(m_sampler, element, queries);
        const CurveQuery middle{scaled(plus(ends[0].xi, ends[1].xi), 0.5), isovalue, std::nullopt};
        const SurfacePoint found = points_of_curves(m_sampler, element, std::span(&middle, 1)).front();
        if (distance_to_segment(found.position, ends[0].position, ends[1].position) > model_share * m_tolerance) {
            return false;
        }
    }
    return true;
}

/** Where the surface ends in an outer face, its edge is a curve there, which sides of triangles are to follow. */
void CellJudge::judge_rims(ElementCells& cells, const std::vector<Piece>& pieces, std::uint32_t outer_faces) const {
    struct Side {
        const Piece* piece;
        std::uint32_t from, to;
    };
    std::vector<Side> sides;
    std::vector<CurveQuery> queries;
    for (const Piece& piece : pieces) {
        const Cell& cell = cells.cells()[piece.cell];
        for (std::size_t side = 0; side < 3; ++side) {
            const std::uint32_t from = piece.triangle[side], to = piece.triangle[(side + 1) % 3];
            std::uint32_t faces = faces_holding(cells, from) & faces_holding(cells, to) & outer_faces;
            faces &= cell.local_face >= 0 ? ~(1u << cell.local_face) : ~0u;
            if (faces != 0) {
                CurveQuery query;
                query.xi = scaled(plus(cells.points()[from].xi, cells.points()[to].xi), 0.5);
                query.face = shape_faces(cells.shape()).normals[static_cast<std::size_t>(std::countr_zero(faces))];
                queries.push_back(query);
                sides.push_back({&piece, from, to});
            }
        }
    }
    // Where the surface is a face, its edges are where they are.
    const std::vector<SurfacePoint> found = points_of_curves(m_sampler, {cells.element(), cells.shape(), {}}, queries);
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double off = distance_to_segment(found[i].position, cells.points()[sides[i].from].position,
                                               cells.points()[sides[i].to].position);
        if (off > model_share * m_tolerance) {
            cells.cells()[sides[i].piece->cell].state = Cell::State::wanted;
        }
    }
}

void CellJudge::judge_triangles(ElementCells& cells, const std::vector<std::size_t>& chosen, double contour_bend,
                                std::uint32_t outer_faces) const {
    cells.meet_edges(m_sampler, chosen);
    std::vector<Piece> pieces;
    std::vector<Vector3> xi;
    for (const std::size_t index : chosen) {
        if (LongestSide(cells, corners_of(cells.cells()[index])).length <= m_tolerance) {
            continue;
        }
        for (const CellTriangle& triangle : cells.triangles(cells.cells()[index])) {
            pieces.push_back({index, triangle});
            for (const auto& weights : sample_weights) {
                Vector3 point{};
                for (std::size_t i = 0; i < 3; ++i) {
                    point = plus(point, scaled(cells.points()[triangle[i]].xi, weights[i]));
                }
                xi.push_back(point);
            }
        }
    }
    std::vector<SurfacePoint> samples = m_sampler.at(cells.element(), xi, {});
    for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
        Cell& cell = cells.cells()[pieces[piece].cell];
        const CellTriangle& triangle = pieces[piece].triangle;
        const Triangle3 flat = flat_triangle(cells, triangle);
        double deviation = 0;
        for (std::size_t k = 0; k < sample_weights.size(); ++k) {
            SurfacePoint& sample = samples[piece * sample_weights.size() + k];
            sample.level.slope = cell.n_corners == 3 ? surface_element(cells, cell).face_normal : sample.level.slope;
            deviation = std::max(deviation, distance_to_plane(predicted_surface(sample), flat));
        }
        const bool is_fine = deviation <= model_share * m_tolerance &&
                             (m_contours.empty() ||
                              (are_contours_clear(cells, triangle, contour_bend) && are_contours_fine(cells, cell, triangle)));
        cell.state = is_fine ? cell.state : Cell::State::wanted;
    }
    judge_rims(cells, pieces, outer_faces);
}

bool CellJudge::judge(ElementCells& cells, const Bend& bend, unsigned least_depth, std::uint32_t outer_faces) const {
    std::vector<std::size_t> chosen, with_surface;
    for (std::size_t index = 0; index < cells.cells().size(); ++index) {
        Cell& cell = cells.cells()[index];
        if (cell.state != Cell::State::fresh) {
            continue;
        }
        cell.state = Cell::State::settled;
        if (cell.n_corners == 4) {
            const CornerData data(cells, corners_of(cell));
            // Where a field is no number it has no surface.
            const bool is_number = std::ranges::all_of(data.values, [](double value) { return std::isfinite(value); });
            if (!is_number || data.function(bend.level).is_nowhere_zero()) {
                cell.state = Cell::State::gone;
                continue;
            }
        }
        if (cell.depth < least_depth && LongestSide(cells, corners_of(cell)).length > m_tolerance) {
            cell.state = Cell::State::wanted;
            continue;
        }
        chosen.push_back(index);
        if (cells.has_surface(cell)) {
            with_surface.push_back(index);
        }
    }
    judge_triangles(cells, with_surface, bend.contour, outer_faces);
    bool has_sampled = false;
    std::erase_if(chosen, [&](std::size_t index) { return cells.cells()[index].state == Cell::State::wanted; });
    look_for_hidden_parts(cells, chosen, bend, has_sampled);
    return has_sampled;
}

} // namespace elvis
