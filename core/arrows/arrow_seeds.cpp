#include <core/arrows/arrow_seeds.hpp>

#include <core/arrows/sparse_points.hpp>
#include <core/base/error.hpp>
#include <core/extract/extraction.hpp>
#include <core/probe/cpu_evaluator.hpp>
#include <core/volume/boundary/element_faces.hpp>

#include <elvis/native/space.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace elvis {

namespace {

/** More are too close to be told apart in any picture. */
constexpr double most_points = 1e6;
/** Candidates are so close to each other, as a share of the spacing. */
constexpr double candidate_step = 0.3;

void need_few(double n_points) {
    if (!(n_points <= most_points)) {
        throw Error("arrows", "the spacing is too small: there would be about " + std::to_string(n_points) +
                                  " places to look at, and 1000000 are the most");
    }
}

/** Of a lattice through 0: the multiples of the spacing in [-reach, reach]. */
std::vector<double> steps_within(double reach, double spacing) {
    std::vector<double> steps;
    const auto n = static_cast<std::int64_t>(std::floor(reach / spacing));
    for (std::int64_t i = -n; i <= n; ++i) {
        steps.push_back(static_cast<double>(i) * spacing);
    }
    return steps;
}

std::array<Vector3, 2> across(const Vector3& normal) {
    std::size_t least = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
        least = std::abs(normal[axis]) < std::abs(normal[least]) ? axis : least;
    }
    Vector3 other{};
    other[least] = 1;
    const Vector3 first = unit(cross(normal, other));
    return {first, cross(normal, first)};
}

elvis_shape shape_of(const RuntimeVolume& volume, std::uint64_t element) {
    return std::prev(std::ranges::upper_bound(volume.classes(), element, {}, &ClassInfo::first_element))->shape;
}

Vector3 position_of(const RuntimeVolume& volume, const ReferencePoint& place) {
    Vector3 position{};
    volume.evaluate_mapping(place.element, place.xi, position, {});
    return position;
}

/** Of n + 1 points along each side: weights of three or four corners. */
std::vector<std::vector<double>> lattice_of_face(std::size_t n_corners, int n) {
    std::vector<std::vector<double>> weights;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= (n_corners == 3 ? n - j : n); ++i) {
            const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n;
            weights.push_back(n_corners == 3 ? std::vector{1 - u - v, u, v}
                                             : std::vector{(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v});
        }
    }
    return weights;
}

/** `corners` in their order round the face. */
Vector3 weighted(const std::vector<Vector3>& corners, const std::vector<double>& weights) {
    Vector3 sum{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        sum = plus(sum, scaled(corners[i], weights[i]));
    }
    return sum;
}

} // namespace

ArrowSeeds::ArrowSeeds(const RuntimeVolume& volume, double spacing, const TaskControl& control)
    : m_volume(volume), m_spacing(spacing), m_control(control), m_finder(volume) {}

std::vector<ArrowSeed> ArrowSeeds::found(const std::vector<Vector3>& positions) const {
    std::vector<ArrowSeed> seeds;
    for (const Vector3& position : positions) {
        m_control.check();
        const std::vector<ReferencePoint> holders = m_finder.holders(m_volume, position);
        if (!holders.empty()) {
            seeds.push_back({holders.front(), position});
        }
    }
    return seeds;
}

std::vector<ArrowSeed> ArrowSeeds::in_volume(const std::array<double, 6>& bounds) const {
    std::array<std::vector<double>, 3> steps;
    double n = 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double reach = 0.5 * (bounds[3 + axis] - bounds[axis]);
        n *= 2 * reach / m_spacing + 1;
        need_few(n);
        steps[axis] = steps_within(reach, m_spacing);
    }
    std::vector<Vector3> positions;
    for (const double z : steps[2]) {
        for (const double y : steps[1]) {
            for (const double x : steps[0]) {
                positions.push_back(
                    {0.5 * (bounds[0] + bounds[3]) + x, 0.5 * (bounds[1] + bounds[4]) + y, 0.5 * (bounds[2] + bounds[5]) + z});
            }
        }
    }
    return found(positions);
}

std::vector<ArrowSeed> ArrowSeeds::on_plane(const CutPlane& plane, const std::array<double, 6>& bounds) const {
    const auto& [a, b, c, d] = plane.plane;
    const double size = std::hypot(a, b, c);
    const Vector3 normal{a / size, b / size, c / size};
    const Vector3 middle{0.5 * (bounds[0] + bounds[3]), 0.5 * (bounds[1] + bounds[4]), 0.5 * (bounds[2] + bounds[5])};
    const Vector3 origin = minus(middle, scaled(normal, dot(normal, middle) + d / size));
    const auto [first, second] = across(normal);
    const double reach = 0.5 * length({bounds[3] - bounds[0], bounds[4] - bounds[1], bounds[5] - bounds[2]});
    need_few(std::pow(2 * reach / m_spacing + 1, 2));
    std::vector<Vector3> positions;
    for (const double v : steps_within(reach, m_spacing)) {
        for (const double u : steps_within(reach, m_spacing)) {
            positions.push_back(plus(origin, plus(scaled(first, u), scaled(second, v))));
        }
    }
    return found(positions);
}

std::vector<ArrowSeed> ArrowSeeds::on_boundary(const BoundaryFaces& boundary) const {
    SparsePoints kept(m_spacing);
    std::vector<ArrowSeed> seeds;
    double n_looked_at = 0;
    for (const ElementFace& face : boundary_faces(m_volume, boundary.groups, &m_control)) {
        m_control.check();
        const auto shape = static_cast<native::Shape>(shape_of(m_volume, face.element));
        std::vector<Vector3> corners;
        for (const int corner : native::face_corners(shape, static_cast<int>(face.local_face))) {
            const native::Point xi = native::corner(shape, corner);
            corners.push_back({xi[0], xi[1], xi[2]});
        }
        double longest = 0;
        const Vector3 first = position_of(m_volume, {face.element, corners[0]});
        for (const Vector3& corner : corners) {
            longest = std::max(longest, length(minus(position_of(m_volume, {face.element, corner}), first)));
        }
        // Curved faces are longer than their chords.
        const double n = std::ceil(1.5 * longest / (candidate_step * m_spacing));
        n_looked_at += n * n;
        need_few(n_looked_at);
        for (const std::vector<double>& weights : lattice_of_face(corners.size(), std::max(1, static_cast<int>(n)))) {
            const ReferencePoint place{face.element, weighted(corners, weights)};
            const Vector3 position = position_of(m_volume, place);
            if (kept.add(position)) {
                seeds.push_back({place, position});
            }
        }
    }
    return seeds;
}

/** Newton's method along the gradient, from a point near the surface. */
std::optional<ArrowSeed> ArrowSeeds::on_level(PointEvaluator& evaluator, const std::shared_ptr<const Expression>& level,
                                              double value, std::uint32_t time_step, Vector3 position) const {
    constexpr int most_steps = 20;
    // Of the spacing: what is left after the step before is its square.
    constexpr double small = 1e-9;
    for (int step = 0; step < most_steps; ++step) {
        const std::vector<ReferencePoint> holders = m_finder.holders(m_volume, position);
        if (holders.empty()) {
            return std::nullopt;
        }
        const ExpressionSample sample = evaluator.evaluate(level, time_step, std::span(holders).first(1), true).front();
        const double square = dot(sample.gradient, sample.gradient);
        const Vector3 move = scaled(sample.gradient, (value - sample.value) / square);
        if (!(length(move) < m_spacing)) {
            return std::nullopt;
        }
        if (length(move) <= small * m_spacing) {
            return ArrowSeed{holders.front(), position};
        }
        position = plus(position, move);
    }
    return std::nullopt;
}

std::vector<ArrowSeed> ArrowSeeds::on_isosurfaces(const std::shared_ptr<const Expression>& level,
                                                  const std::vector<double>& values, std::uint32_t time_step) const {
    CpuEvaluator evaluator(m_volume);
    std::vector<ArrowSeed> seeds;
    for (const double value : values) {
        ExtractionRequest request;
        request.level_field = level->text();
        request.isovalue = value;
        request.time_step = time_step;
        request.tolerance = std::clamp(0.1 * m_spacing / m_finder.diagonal(), 1e-4, 1e-2);
        const SurfaceMesh mesh = extract(m_volume, request, m_control);
        SparsePoints kept(m_spacing);
        for (const auto& triangle : mesh.triangles) {
            m_control.check();
            const std::vector<Vector3> corners = {mesh.positions[triangle[0]], mesh.positions[triangle[1]],
                                                  mesh.positions[triangle[2]]};
            const double longest = std::max({length(minus(corners[1], corners[0])), length(minus(corners[2], corners[1])),
                                             length(minus(corners[0], corners[2]))});
            const int n = std::max(1, static_cast<int>(std::ceil(longest / (candidate_step * m_spacing))));
            for (const std::vector<double>& weights : lattice_of_face(3, n)) {
                const Vector3 candidate = weighted(corners, weights);
                if (!kept.has_room(candidate)) {
                    continue;
                }
                const std::optional<ArrowSeed> seed = on_level(evaluator, level, value, time_step, candidate);
                if (seed && kept.add(seed->position)) {
                    seeds.push_back(*seed);
                }
            }
        }
    }
    return seeds;
}

} // namespace elvis
