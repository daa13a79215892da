#include <core/arrows/arrow_seeds.hpp>

#include <core/arrows/even_points.hpp>
#include <core/arrows/shape_candidates.hpp>
#include <core/extract/extraction.hpp>
#include <core/probe/cpu_evaluator.hpp>
#include <core/volume/boundary/element_faces.hpp>
#include <core/volume/element/flat_height.hpp>

#include <elvis/native/space.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>

namespace elvis {

namespace {

/** Candidates are so close to each other, as a share of the spacing. */
constexpr double candidate_step = 0.2;

/** Of a lattice through 0: the multiples of the spacing in [-reach, reach]. */
std::vector<double> steps_within(double reach, double spacing) {
    std::vector<double> steps;
    const auto n = static_cast<std::int64_t>(std::floor(reach / spacing));
    for (std::int64_t i = -n; i <= n; ++i) {
        steps.push_back(static_cast<double>(i) * spacing);
    }
    return steps;
}

elvis_shape shape_of(const RuntimeVolume& volume, std::uint64_t element) {
    return std::prev(std::ranges::upper_bound(volume.classes(), element, {}, &ClassInfo::first_element))->shape;
}

/** In order around it; of an element of two dimensions its own. */
std::vector<Vector3> corners_of(const ElementFace& face, native::Shape shape) {
    std::vector<Vector3> corners;
    const auto add = [&](int corner) {
        const native::Point xi = native::corner(shape, corner);
        corners.push_back({xi[0], xi[1], xi[2]});
    };
    if (native::dimension(shape) == 2) {
        for (int corner = 0; corner < native::n_corners(shape); ++corner) {
            add(corner);
        }
    } else {
        std::ranges::for_each(native::face_corners(shape, static_cast<int>(face.local_face)), add);
    }
    return corners;
}

Vector3 position_of(const RuntimeVolume& volume, const ReferencePoint& place) {
    Vector3 position{};
    volume.evaluate_mapping(place.element, place.xi, position, {});
    return position;
}

} // namespace

ArrowSeeds::ArrowSeeds(const RuntimeVolume& volume, double spacing, const TaskControl& control)
    : m_volume(volume), m_spacing(spacing), m_control(control), m_finder(volume) {}

std::optional<ArrowSeed> ArrowSeeds::seed_at(const Vector3& position) const {
    m_control.check();
    const std::vector<ReferencePoint> holders = m_finder.holders(m_volume, position);
    return holders.empty() ? std::nullopt : std::optional(ArrowSeed{holders.front(), position});
}

std::vector<ArrowSeed> ArrowSeeds::found(const std::vector<Vector3>& positions) const {
    std::vector<ArrowSeed> seeds;
    for (const Vector3& position : positions) {
        if (const std::optional<ArrowSeed> seed = seed_at(position)) {
            seeds.push_back(*seed);
        }
    }
    return seeds;
}

std::vector<ArrowSeed> ArrowSeeds::in_volume(const std::array<double, 6>& bounds) const {
    if (m_volume.dimension() == 2 && !flat_height(m_volume)) {
        return on_faces(surface_elements(m_volume));
    }
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

std::vector<ArrowSeed> ArrowSeeds::chosen(const std::vector<Vector3>& candidates,
                                          const std::function<std::optional<ArrowSeed>(std::size_t candidate)>& make) const {
    std::map<std::size_t, ArrowSeed> made;
    const auto place = [&](std::size_t candidate) -> std::optional<Vector3> {
        m_control.check();
        const std::optional<ArrowSeed> seed = make(candidate);
        if (!seed) {
            return std::nullopt;
        }
        made.emplace(candidate, *seed);
        return seed->position;
    };
    std::vector<ArrowSeed> seeds;
    for (const std::size_t candidate : choose_evenly(candidates, m_spacing, place)) {
        seeds.push_back(made.at(candidate));
    }
    return seeds;
}

std::vector<ArrowSeed> ArrowSeeds::on_faces(const std::vector<ElementFace>& faces) const {
    Candidates candidates(candidate_step * m_spacing);
    std::vector<ArrowSeed> seeds;
    for (const ElementFace& face : faces) {
        m_control.check();
        const std::vector<Vector3> corners = corners_of(face, static_cast<native::Shape>(shape_of(m_volume, face.element)));
        double longest = 0;
        const Vector3 first = position_of(m_volume, {face.element, corners[0]});
        for (const Vector3& corner : corners) {
            longest = std::max(longest, length(minus(position_of(m_volume, {face.element, corner}), first)));
        }
        // Curved faces are longer than their chords.
        const double n = std::max(1.0, std::ceil(1.5 * longest / (candidate_step * m_spacing)));
        need_few(n * n);
        for (const std::vector<double>& weights : lattice_of_face(corners.size(), static_cast<int>(n))) {
            const ReferencePoint place{face.element, weighted(corners, weights)};
            const Vector3 position = position_of(m_volume, place);
            if (candidates.add(position)) {
                seeds.push_back({place, position});
            }
        }
    }
    return chosen(candidates.points(), [&](std::size_t candidate) { return seeds[candidate]; });
}

std::optional<std::vector<ArrowSeed>> ArrowSeeds::on_shape(const CutShape& shape) const {
    Candidates candidates(candidate_step * m_spacing);
    if (!add_shape(shape, candidates)) {
        return std::nullopt;
    }
    return chosen(candidates.points(), [&](std::size_t candidate) { return seed_at(candidates.points()[candidate]); });
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

std::vector<ArrowSeed> ArrowSeeds::on_levels(const std::shared_ptr<const Expression>& level, const std::vector<double>& values,
                                             std::uint32_t time_step) const {
    CpuEvaluator evaluator(m_volume);
    std::vector<ArrowSeed> seeds;
    for (const double value : values) {
        ExtractionRequest request;
        request.level_field = level->text();
        request.isovalue = value;
        request.time_step = time_step;
        request.tolerance = std::clamp(0.1 * m_spacing / m_finder.diagonal(), 1e-4, 1e-2);
        const SurfaceMesh mesh = extract(m_volume, request, m_control);
        Candidates candidates(candidate_step * m_spacing);
        for (const auto& triangle : mesh.triangles) {
            candidates.add_triangle({mesh.positions[triangle[0]], mesh.positions[triangle[1]], mesh.positions[triangle[2]]});
        }
        std::ranges::copy(chosen(candidates.points(),
                                 [&](std::size_t candidate) {
                                     return on_level(evaluator, level, value, time_step, candidates.points()[candidate]);
                                 }),
                          std::back_inserter(seeds));
    }
    return seeds;
}

} // namespace elvis
