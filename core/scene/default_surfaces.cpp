#include <core/scene/default_surfaces.hpp>

#include <core/base/vector3.hpp>
#include <core/scene/resolve.hpp>

#include <elvis/native/space.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace elvis {

namespace {

/** A boundary whose values span less of the field's than this shows nothing of it: a dozen of 256 colours. */
constexpr double flat_share = 0.05;
/** Of the samples on the boundary, at either end: an obstacle or an inflow, a smaller part of it, may have other values. Less
 * would show the canister of tests/data, whose inner wall has many faces, as one colour. */
constexpr double left_out_share = 0.15;
/** Faces that are looked at, spread over all: some milliseconds. */
constexpr std::uint64_t most_faces = 1024;

/** Reference coordinates of points of a local face: its middle, its corners, and half-way between. */
std::vector<double> points_of_face(native::Shape shape, int local_face) {
    const auto corners = native::face_corners(shape, local_face);
    native::Point middle{};
    for (const int corner : corners) {
        const native::Point x = native::corner(shape, corner);
        for (std::size_t d = 0; d < 3; ++d) {
            middle[d] += x[d] / static_cast<double>(corners.size());
        }
    }
    std::vector<double> xi(middle.begin(), middle.end());
    for (const int corner : corners) {
        const native::Point x = native::corner(shape, corner);
        for (const double share : {0.5, 1.0}) {
            for (std::size_t d = 0; d < 3; ++d) {
                xi.push_back((1 - share) * middle[d] + share * x[d]);
            }
        }
    }
    return xi;
}

elvis_shape shape_of(const RuntimeVolume& volume, std::uint64_t element) {
    const auto next = std::ranges::upper_bound(volume.classes(), element, {}, &ClassInfo::first_element);
    return std::prev(next)->shape;
}

/** Length of a vector, or the component itself. */
double value_of(std::span<const double> components, int component) {
    if (component >= 0) {
        return components[static_cast<std::size_t>(component)];
    }
    double sum = 0;
    for (const double one : components) {
        sum += one * one;
    }
    return std::sqrt(sum);
}

/** Of samples on the boundary, all but the smallest and the largest; without any the lower end is infinite, the upper
 * -infinite. */
FieldRange values_on_boundary(const RuntimeVolume& volume, const FieldChoice& field, std::uint32_t time_step) {
    const std::size_t n_components = volume.fields()[field.field].n_components;
    std::vector<elvis_face> faces(volume.n_faces());
    volume.faces(0, faces.size(), faces);
    std::erase_if(faces, [](const elvis_face& face) { return face.neighbour != ELVIS_NEIGHBOUR_NONE; });
    const std::size_t step = faces.size() / most_faces + 1;
    std::vector<double> samples;
    for (std::size_t at = 0; at < faces.size(); at += step) {
        const auto element = static_cast<std::uint64_t>(faces[at].element);
        const auto shape = static_cast<native::Shape>(shape_of(volume, element));
        const std::vector<double> xi = points_of_face(shape, static_cast<int>(faces[at].local_face));
        std::vector<double> values(xi.size() / 3 * n_components);
        volume.evaluate_field(field.field, time_step, element, xi, values, {});
        for (std::size_t point = 0; point < values.size(); point += n_components) {
            samples.push_back(value_of(std::span(values).subspan(point, n_components), field.component));
        }
    }
    std::erase_if(samples, [](double value) { return !std::isfinite(value); });
    if (samples.empty()) {
        constexpr double infinitely_large = std::numeric_limits<double>::infinity();
        return {infinitely_large, -infinitely_large};
    }
    std::ranges::sort(samples);
    const auto n_left_out = static_cast<std::size_t>(left_out_share * static_cast<double>(samples.size()));
    return {samples[n_left_out], samples[samples.size() - 1 - n_left_out]};
}

bool is_flat_on_boundary(const RuntimeVolume& volume, PictureRanges& ranges, const FieldChoice& field,
                         std::uint32_t time_step) {
    if (field.expression || !volume.has_evaluation() || volume.is_cut()) {
        return false;
    }
    const FieldRange all = ranges.extrema(field, time_step).range();
    const FieldRange own = values_on_boundary(volume, field, time_step);
    std::array<double, 2> seen{own.lower, -own.upper};
    ranges.take_minima(seen);
    return -seen[1] - seen[0] < flat_share * (all.upper - all.lower);
}

} // namespace

bool has_faces(const RuntimeVolume& volume, PictureRanges& ranges) {
    double has_none = volume.n_faces() == 0 ? 1 : 0;
    ranges.take_minima(std::span(&has_none, 1));
    return has_none == 0;
}

std::vector<SceneSurface> default_surfaces(const SceneCamera& camera, const RuntimeVolume& volume, PictureRanges& ranges,
                                           const FieldChoice& field, std::uint32_t time_step) {
    if (volume.dimension() == 2) {
        return {SceneSurface{FlatElements{}}};
    }
    const std::array<double, 6> bounds = ranges.bounds();
    const CutPlane plane = central_plane(bounds);
    if (!has_faces(volume, ranges)) {
        return {SceneSurface{plane}};
    }
    SceneSurface boundary{BoundaryFaces{}};
    if (!is_flat_on_boundary(volume, ranges, field, time_step)) {
        return {boundary};
    }
    // The default camera looks from the plane's positive side.
    const auto& [a, b, c, d] = plane.plane;
    const bool is_behind = camera.eye && dot({a, b, c}, *camera.eye) + d < 0;
    const double side = is_behind ? 1 : -1;
    boundary.clip.push_back({side * a, side * b, side * c, side * d});
    return {SceneSurface{plane}, boundary};
}

} // namespace elvis
