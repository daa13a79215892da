#include "segments.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace elvis::oracle {
namespace {

using Vector2 = Eigen::Vector2d;
using Matrix2 = Eigen::Matrix2d;

// Sideways distances from the line, and the distance along it.
struct SeenPatch {
    std::array<std::size_t, 2> order{};
    std::vector<Vector> points;

    const Vector& at(std::size_t i, std::size_t j) const { return points[j * (order[0] + 1) + i]; }
    std::size_t stride(std::size_t direction) const { return direction == 0 ? 1 : order[0] + 1; }

    Vector evaluate(double u, double v, Vector* along_u, Vector* along_v) const;
    std::array<SeenPatch, 2> split(std::size_t direction) const;
};

// De Casteljau's algorithm; the last step but one gives the derivative.
Vector reduce(std::vector<Vector>& points, double u, Vector* slope) {
    const std::size_t n = points.size() - 1;
    if (slope != nullptr)
        slope->setZero();
    for (std::size_t level = n; level > 0; --level) {
        if (level == 1 && slope != nullptr)
            *slope = static_cast<double>(n) * (points[1] - points[0]);
        for (std::size_t i = 0; i < level; ++i)
            points[i] += u * (points[i + 1] - points[i]);
    }
    return points[0];
}

Vector SeenPatch::evaluate(double u, double v, Vector* along_u, Vector* along_v) const {
    thread_local std::vector<Vector> row, column, slopes;
    column.clear();
    slopes.clear();
    for (std::size_t j = 0; j <= order[1]; ++j) {
        row.assign(points.begin() + static_cast<std::ptrdiff_t>(j * (order[0] + 1)),
                   points.begin() + static_cast<std::ptrdiff_t>((j + 1) * (order[0] + 1)));
        Vector slope;
        column.push_back(reduce(row, u, &slope));
        slopes.push_back(slope);
    }
    *along_u = reduce(slopes, v, nullptr);
    return reduce(column, v, along_v);
}

std::array<SeenPatch, 2> SeenPatch::split(std::size_t direction) const {
    std::array<SeenPatch, 2> halves{*this, *this};
    const std::size_t n = order[direction], step = stride(direction);
    for (std::size_t line = 0; line <= order[1 - direction]; ++line) {
        const std::size_t first = line * stride(1 - direction);
        std::vector<Vector>& high = halves[1].points;
        for (std::size_t level = 0; level <= n; ++level) {
            halves[0].points[first + level * step] = high[first];
            for (std::size_t i = 0; i + level < n; ++i)
                high[first + i * step] = 0.5 * (high[first + i * step] + high[first + (i + 1) * step]);
        }
    }
    return halves;
}

// Whether the line, at the origin of the first two coordinates, may meet what `to_unit` makes of the patch.
bool may_meet(const SeenPatch& patch, const Matrix2& to_unit, double margin) {
    Vector2 lower = Vector2::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
    for (const Vector& p : patch.points) {
        const Vector2 q = to_unit * p.head<2>();
        lower = lower.cwiseMin(q);
        upper = upper.cwiseMax(q);
    }
    return lower.maxCoeff() <= margin && upper.minCoeff() >= -margin;
}

// Whether the line sees the patch edge on, thinner than `rounding`: then it runs in the face, and enters and leaves by other
// ones.
bool is_edge_on(const SeenPatch& patch, double rounding) {
    const Vector2 first = patch.points.front().head<2>();
    Vector2 longest = Vector2::Zero();
    for (const Vector& p : patch.points)
        if ((p.head<2>() - first).squaredNorm() > longest.squaredNorm())
            longest = p.head<2>() - first;
    const Vector2 across = Vector2(-longest.y(), longest.x()).normalized();
    return std::ranges::all_of(patch.points,
                               [&](const Vector& p) { return std::abs(across.dot(p.head<2>() - first)) <= rounding; });
}

// Mean of the slopes of the control net in two directions.
Matrix2 mean_slope(const SeenPatch& patch) {
    const auto corner = [&](std::size_t i, std::size_t j) -> Vector2 {
        return patch.at(i * patch.order[0], j * patch.order[1]).head<2>();
    };
    Matrix2 slope;
    slope.col(0) = 0.5 * (corner(1, 0) - corner(0, 0) + corner(1, 1) - corner(0, 1));
    slope.col(1) = 0.5 * (corner(0, 1) - corner(0, 0) + corner(1, 1) - corner(1, 0));
    return slope;
}

// The constraint that holds as an equation on a side of the cube of collapsed coordinates that is no edge or corner.
std::size_t constraint_of_side(native::Shape shape, std::size_t direction, bool is_upper) {
    native::Point eta{};
    eta[direction] = is_upper ? 1 : -1;
    const native::Point middle = native::expand(shape, eta);
    const auto constraints = face_constraints(shape);
    const auto room = [&](const FaceConstraint& face) {
        return std::abs(face.normal.dot(Vector(middle[0], middle[1], middle[2])) - face.offset);
    };
    return static_cast<std::size_t>(std::ranges::min_element(constraints, {}, room) - constraints.begin());
}

double scale_of(const Enclosure& box, const Line& line) {
    return (box.upper - box.lower).norm() + (0.5 * (box.lower + box.upper) - line.origin).norm();
}

// Bound of |to_unit J - 1| in the maximum norm over the patch: below 1 the patch is one to one as the line sees it.
double nonlinearity(const SeenPatch& patch, const Matrix2& to_unit) {
    std::array<Vector2, 2> off{Vector2::Zero(), Vector2::Zero()};
    for (std::size_t direction = 0; direction < 2; ++direction)
        for (std::size_t j = 0; j <= patch.order[1]; ++j)
            for (std::size_t i = 0; i <= patch.order[0]; ++i) {
                if ((direction == 0 ? i : j) == patch.order[direction])
                    continue;
                const Vector& next = direction == 0 ? patch.at(i + 1, j) : patch.at(i, j + 1);
                const Vector2 slope = static_cast<double>(patch.order[direction]) * to_unit * (next - patch.at(i, j)).head<2>();
                const Vector2 unit = Vector2::Unit(static_cast<Eigen::Index>(direction));
                off[direction] = off[direction].cwiseMax((slope - unit).cwiseAbs());
            }
    return (off[0] + off[1]).maxCoeff();
}

// Distance at which the line meets a patch that it sees one to one; NaN if it does not, nothing if the steps come to no end.
std::optional<double> meet(const SeenPatch& patch, const Matrix2& to_unit) {
    Vector2 uv = Vector2::Constant(0.5);
    Vector x, along_u, along_v;
    bool is_done = false;
    for (int turn = 0; turn < 60 && !is_done; ++turn) {
        x = patch.evaluate(uv.x(), uv.y(), &along_u, &along_v);
        Matrix2 slope;
        slope << along_u.head<2>(), along_v.head<2>();
        Vector2 step = slope.inverse() * x.head<2>();
        // Newton's step in the unit square, beyond it the slower but safe one.
        if (!step.allFinite() || step.cwiseAbs().maxCoeff() > 0.7)
            step = to_unit * x.head<2>();
        uv -= step;
        // Far beyond the patch there is nothing to find, and the bounds do not hold.
        if (uv.cwiseAbs().maxCoeff() > 3)
            return std::numeric_limits<double>::quiet_NaN();
        is_done = step.cwiseAbs().maxCoeff() < 1e-14;
    }
    // Some steps of rounding remain where the line nearly touches the patch.
    if (!is_done && x.head<2>().norm() > 1e-9 * mean_slope(patch).norm())
        return std::nullopt;
    const double excess = (uv - Vector2::Constant(0.5)).cwiseAbs().maxCoeff() - 0.5;
    return excess <= 1e-11 ? patch.evaluate(uv.x(), uv.y(), &along_u, &along_v).z() : std::numeric_limits<double>::quiet_NaN();
}

} // namespace

SegmentFinder::SegmentFinder(const Model& model) : m_model(model), m_faces(model.enclosures.size()) {
    for (std::size_t element = 0; element < m_faces.size(); ++element) {
        const Enclosure& enclosure = model.enclosures[element];
        if (enclosure.is_folded)
            throw std::invalid_argument("isosurfaces of the oracle need elements that are not folded");
        const Patch& patch = enclosure.patch;
        const double size = (enclosure.upper - enclosure.lower).norm();
        for (std::size_t direction = 0; direction < 3; ++direction)
            for (const std::size_t side : {std::size_t{0}, std::size_t{patch.order[direction]}}) {
                const std::size_t first = direction == 0 ? 1 : 0, second = direction == 2 ? 1 : 2;
                Face face;
                face.constraint = constraint_of_side(model.volume.shape(element), direction, side > 0);
                face.order = {patch.order[first], patch.order[second]};
                std::array<double, 2> extent{};
                for (std::size_t j = 0; j <= face.order[1]; ++j)
                    for (std::size_t i = 0; i <= face.order[0]; ++i) {
                        std::array<std::size_t, 3> index{};
                        index[direction] = side;
                        index[first] = i;
                        index[second] = j;
                        face.points.push_back(patch.at(index[0], index[1], index[2]));
                        const Vector& here = face.points.back();
                        const std::size_t row = face.order[0] + 1;
                        if (i > 0)
                            extent[0] = std::max(extent[0], (here - face.points[j * row + i - 1]).norm());
                        if (j > 0)
                            extent[1] = std::max(extent[1], (here - face.points[(j - 1) * row + i]).norm());
                    }
                // Sides of the cube that collapse to an edge or a corner are no faces.
                if (std::min(extent[0], extent[1]) > 1e-9 * size)
                    m_faces[element].push_back(std::move(face));
            }
    }
}

std::vector<SegmentFinder::Entry> SegmentFinder::boxes(const Line& line) const {
    std::vector<Entry> entries;
    for (std::size_t element = 0; element < m_faces.size(); ++element) {
        const Enclosure& box = m_model.enclosures[element];
        double from = 0, to = std::numeric_limits<double>::infinity();
        for (Eigen::Index d = 0; d < 3; ++d) {
            if (line.direction[d] == 0) {
                if (line.origin[d] < box.lower[d] || line.origin[d] > box.upper[d])
                    to = -1;
                continue;
            }
            const double one = (box.lower[d] - line.origin[d]) / line.direction[d];
            const double other = (box.upper[d] - line.origin[d]) / line.direction[d];
            from = std::max(from, std::min(one, other));
            to = std::min(to, std::max(one, other));
        }
        // The boxes have margins far above rounding.
        if (from <= to)
            entries.push_back({element, from});
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.from < b.from; });
    return entries;
}

void SegmentFinder::cross(const Face& face, const Line& line, double scale, std::vector<double>& crossings) {
    const Vector across = line.direction.unitOrthogonal(), up = line.direction.cross(across);
    SeenPatch whole{face.order, {}};
    for (const Vector& p : face.points) {
        const Vector away = p - line.origin;
        whole.points.emplace_back(across.dot(away), up.dot(away), line.direction.dot(away));
    }
    const double rounding = 1e-15 * scale;
    std::vector<SeenPatch> stack{std::move(whole)};
    while (!stack.empty()) {
        const SeenPatch patch = std::move(stack.back());
        stack.pop_back();
        if (!may_meet(patch, Matrix2::Identity(), rounding))
            continue;
        if (is_edge_on(patch, 10 * rounding))
            continue;
        const Matrix2 slope = mean_slope(patch);
        const Matrix2 to_unit = slope.inverse();
        const double size = slope.cwiseAbs().maxCoeff();
        if (to_unit.allFinite() && to_unit.norm() * size < 1e6) {
            if (!may_meet(patch, to_unit, 1e-10))
                continue;
            if (nonlinearity(patch, to_unit) < 0.7) {
                if (const std::optional<double> t = meet(patch, to_unit)) {
                    if (!std::isnan(*t))
                        crossings.push_back(*t);
                    continue;
                }
            }
        }
        std::array<double, 2> extent{};
        for (std::size_t j = 0; j <= patch.order[1]; ++j)
            for (std::size_t i = 0; i <= patch.order[0]; ++i) {
                if (i > 0)
                    extent[0] =
                        std::max(extent[0], static_cast<double>(patch.order[0]) * (patch.at(i, j) - patch.at(i - 1, j)).norm());
                if (j > 0)
                    extent[1] =
                        std::max(extent[1], static_cast<double>(patch.order[1]) * (patch.at(i, j) - patch.at(i, j - 1)).norm());
            }
        // The line meets a corner to which the face collapses.
        if (std::max(extent[0], extent[1]) < 1e-13 * scale) {
            crossings.push_back(patch.at(0, 0).z());
            continue;
        }
        for (SeenPatch& half : patch.split(extent[0] >= extent[1] ? 0 : 1))
            stack.push_back(std::move(half));
    }
}

std::vector<double> SegmentFinder::crossings(std::size_t element, std::size_t constraint, const Line& line) const {
    std::vector<double> crossings;
    for (const Face& face : m_faces[element])
        if (face.constraint == constraint)
            cross(face, line, scale_of(m_model.enclosures[element], line), crossings);
    return crossings;
}

std::vector<RaySegment> SegmentFinder::find(std::size_t element, const Line& line, Inverter& inverter) const {
    const Enclosure& box = m_model.enclosures[element];
    const double scale = scale_of(box, line);
    std::vector<double> crossings;
    for (const Face& face : m_faces[element])
        cross(face, line, scale, crossings);
    // The eye may lie inside.
    if ((line.origin - box.lower).minCoeff() >= 0 && (box.upper - line.origin).minCoeff() >= 0)
        crossings.push_back(0);
    std::erase_if(crossings, [](double t) { return t < 0; });
    std::sort(crossings.begin(), crossings.end());
    std::vector<RaySegment> segments;
    for (std::size_t i = 1; i < crossings.size(); ++i) {
        const double from = crossings[i - 1], to = crossings[i];
        if (to - from <= 1e-14 * scale)
            continue;
        const std::vector<Solution> found = inverter.find(element, line.at(0.5 * (from + to)), inside_tolerance);
        if (!found.empty())
            segments.push_back({from, to, found.front().xi});
    }
    return segments;
}

} // namespace elvis::oracle
