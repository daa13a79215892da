#include <core/demand/needed_elements.hpp>

#include <core/base/bounds.hpp>
#include <core/camera/camera_ray.hpp>
#include <core/demand/elements_in_blocks.hpp>
#include <core/volume/boundary/element_faces.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace elvis {

namespace {

/**
 * Of the diagonal. Shaders look at elements whose boxes come within some ten roundings of a point's coordinates in single
 * precision (cut_surface/meets_plane.glsl), and of where a pixel's ray meets the plane: a hundred times that.
 */
constexpr double near_by = 1e-4;
/** In pixels: lines look at the whole square of a pixel. */
constexpr double pixels_around = 2;

/** normal . x <= most, for all that is wanted. */
struct HalfSpace {
    Vector3 normal;
    double most;
};

/** Smallest of normal . x in the box. */
double least_in(const ElementBox& box, const Vector3& normal) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        sum += normal[axis] * box[normal[axis] < 0 ? axis + 3 : axis];
    }
    return sum;
}

/** x with offset + slope . (x - eye) <= margin. */
HalfSpace half_space(const Vector3& slope, double offset, const Vector3& eye, double margin) {
    return {slope, margin * length(slope) - offset + dot(slope, eye)};
}

/** Between the rays through the picture's edges, and in front of the eye. */
std::vector<HalfSpace> view_of(const FrameRequest& request, double margin) {
    const Camera& camera = request.camera;
    const auto [first_row, of_height] = request.place();
    const PictureSize size{static_cast<double>(request.width), static_cast<double>(of_height)};
    const auto [left, top] = picture_coordinates(camera, size, {-pixels_around, first_row - pixels_around});
    const auto [right, bottom] =
        picture_coordinates(camera, size, {request.width + pixels_around, first_row + request.height + pixels_around});
    const ViewAxes axes = axes_of(camera);
    // Across the view, what is wanted lies within these multiples of the distance, or of half the picture's height.
    const double unit = camera.orthographic ? 0.5 * camera.height : slope_of(camera);
    const auto side = [&](const Vector3& across, double most, double sign) {
        const Vector3 slope = camera.orthographic ? across : plus(across, scaled(axes.forward, -most * unit));
        return half_space(scaled(slope, sign), camera.orthographic ? -sign * most * unit : 0, camera.eye, margin);
    };
    std::vector<HalfSpace> sides = {side(axes.right, right, 1), side(axes.right, left, -1), side(axes.top, top, 1),
                                    side(axes.top, bottom, -1)};
    if (!camera.orthographic) {
        sides.push_back(half_space(scaled(axes.forward, -1), 0, camera.eye, margin));
    }
    return sides;
}

} // namespace

std::function<bool(const ElementBox&)> meets_plane_in_view(const CutPlane& plane, const FrameRequest& request,
                                                           const ElementBox& bounds) {
    const double margin = near_by * diagonal_of(bounds);
    std::vector<HalfSpace> wanted = view_of(request, margin);
    const Vector3 normal{plane.plane[0], plane.plane[1], plane.plane[2]};
    const double width = margin * length(normal);
    wanted.push_back({normal, width - plane.plane[3]});
    wanted.push_back({scaled(normal, -1), width + plane.plane[3]});
    return [wanted = std::move(wanted)](const ElementBox& box) {
        // What is no number rules nothing out.
        return std::ranges::none_of(wanted, [&](const HalfSpace& half) { return least_in(box, half.normal) > half.most; });
    };
}

namespace {

using Why = std::optional<std::string>;

/** What a kind of surface needs all elements for. */
struct NeedOfKind {
    const Surface& surface;
    const RuntimeVolume& whole;
    DemandRanges& ranges;
    std::uint32_t time_step;

    Why operator()(const CutPlane&) const { return {}; }
    Why operator()(const BoundaryFaces&) const { return whole.is_cut() ? Why("the boundary of elements that are cut") : Why(); }
    Why operator()(const Isosurfaces& isosurfaces) const {
        if (isosurfaces.field.expression) {
            return "an isosurface of an expression";
        }
        if (surface.has_lines()) {
            return "an isosurface with lines on it";
        }
        if (!isosurfaces.skips_by_range) {
            return "an isosurface for which no elements are skipped";
        }
        if (!ranges.are_proven(isosurfaces.field.field, time_step)) {
            return "an isosurface of a field whose ranges are estimates";
        }
        return {};
    }
    Why operator()(const FlatElements&) const { return other(); }
    Why operator()(const ElementFaces&) const { return other(); }
    Why operator()(const WireFrame&) const { return other(); }
    Why operator()(const CutShape&) const { return other(); }

private:
    static Why other() { return "a surface that is no plane, boundary or isosurface"; }
};

/** Finds the elements that a kind of surface needs. */
struct ElementsOfKind {
    const FrameRequest& rows;
    const RuntimeVolume& whole;
    const BoxBlocks& blocks;
    DemandRanges& ranges;
    std::uint64_t most;
    const TaskControl* control;

    using Elements = std::vector<std::uint64_t>;

    Elements operator()(const CutPlane& plane) const {
        return blocks.elements_that(meets_plane_in_view(plane, rows, blocks.bounds()), most);
    }
    Elements operator()(const BoundaryFaces& boundary) const {
        Elements elements;
        for (const ElementFace& face : boundary_faces(whole, boundary.groups, control)) {
            if (elements.empty() || elements.back() != face.element) {
                elements.push_back(face.element);
            }
        }
        if (elements.size() > most) {
            throw TooManyElements{};
        }
        return elements;
    }
    /** Out of sight, too: what is divided into octants is a matter of all that may hold an isovalue. */
    Elements operator()(const Isosurfaces& isosurfaces) const {
        const FieldChoice& field = isosurfaces.field;
        return ranges.blocks_of(field.field, rows.time_step).elements_with(isosurfaces.values, field.component, most);
    }
    template <class Other> Elements operator()(const Other&) const {
        assert(false && "needs_all()");
        return {};
    }
};

} // namespace

std::optional<std::string> needs_all(const FrameRequest& request, const RuntimeVolume& whole, DemandRanges& ranges) {
    if (request.volume) {
        return "the volume itself";
    }
    for (const Surface& surface : request.surfaces) {
        if (const Why why = std::visit(NeedOfKind{surface, whole, ranges, request.time_step}, surface.geometry)) {
            return why;
        }
        if (!surface.conditions.empty()) {
            return "a surface with a threshold";
        }
        if (surface.lic) {
            return "line integral convolution";
        }
    }
    return std::nullopt;
}

std::vector<std::uint64_t> needed_elements(const Surface& surface, const FrameRequest& rows, const RuntimeVolume& whole,
                                           const BoxBlocks& blocks, DemandRanges& ranges, std::uint64_t most,
                                           const TaskControl* control) {
    return std::visit(ElementsOfKind{rows, whole, blocks, ranges, most, control}, surface.geometry);
}

} // namespace elvis
