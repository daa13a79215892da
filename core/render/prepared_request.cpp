#include <core/render/prepared_request.hpp>

#include <core/base/error.hpp>
#include <core/render/field/chosen_values.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

namespace elvis {

namespace {

void check_values(const char* of, const std::vector<double>& values) {
    const bool are_finite = std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
    if (values.empty() || !are_finite || !std::ranges::is_sorted(values)) {
        throw Error(of, "needs finite values, in ascending order");
    }
}

/** Each pixel looks at all pixels so near, in loops that drivers end after 65535 iterations. */
constexpr double widest_line = 176;

void check_width(double width) {
    if (width > widest_line) {
        throw Error("lines", "a width of " + std::to_string(std::lround(width)) +
                                 " pixels, with its image's samples, is more than " + std::to_string(std::lround(widest_line)) +
                                 ", which is the most that is drawn");
    }
}

void check_surface(const Surface& surface, const RuntimeVolume& volume) {
    check_width(std::max(surface.contours ? surface.contours->style.width : 1,
                         surface.mesh_lines ? surface.mesh_lines->style.width : 1));
    const SurfaceTraits traits = traits_of(surface.geometry);
    if (traits.isosurfaces != nullptr) {
        check_values("isosurface", traits.isosurfaces->values);
    }
    if (surface.contours && !surface.contours->values.empty()) {
        check_values("contours", surface.contours->values);
    }
    if (traits.wires != nullptr && volume.is_cut()) {
        throw Error(volume.path(),
                    "has elements that are only parts of their reference shape (elvis_inside): their edges cannot be "
                    "drawn; mesh lines on a surface can");
    }
    const bool is_flat = volume.dimension() == 2;
    if (!(is_flat ? traits.fits_flat : traits.fits_solid)) {
        throw Error(volume.path(), is_flat ? "is two-dimensional: it is drawn as a surface, without planes or boundary"
                                           : "is no surface: planes through it or its boundary can be drawn");
    }
}

/** What is found by place is shown by points. */
void check_by_place(const Surface& surface, const RuntimeVolume& volume) {
    const auto refuse = [&](const char* what, const char* why) {
        throw Error(what,
                    "of '" + surface.field_label + "', which takes fields that are found by place in another volume, " + why);
    };
    const Isosurfaces* const isosurfaces = traits_of(surface.geometry).isosurfaces;
    if (isosurfaces != nullptr && is_by_place(isosurfaces->field, volume)) {
        refuse("isosurfaces",
               "cannot be found: nothing is known of them between points. They can have its colours (color_field)");
    }
    if (surface.contours && is_by_place(surface.field, volume)) {
        refuse("contours", "cannot be found: nothing is known of them between points");
    }
}

Surface on_isosurface(const Surface& looks, const FieldChoice& field, double value) {
    Surface surface = looks;
    Isosurfaces isosurface;
    isosurface.field = field;
    isosurface.values = {value};
    surface.geometry = std::move(isosurface);
    return surface;
}

/** What else bounds the part that a surface shows the whole boundary of: where elements are cut. */
std::vector<Surface> boundary_inside(const Surface& surface, const RuntimeVolume& volume) {
    std::vector<Surface> inside;
    if (!traits_of(surface.geometry).is_whole_boundary) {
        return inside;
    }
    if (volume.is_cut()) {
        FieldChoice own;
        own.is_own_boundary = true;
        inside.push_back(on_isosurface(surface, own, 0));
    }
    for (std::size_t index = 0; index < surface.conditions.size(); ++index) {
        const Condition& condition = surface.conditions[index];
        inside.push_back(on_isosurface(surface, condition.field, condition.value));
        // On the surface itself rounding would decide.
        inside.back().conditions.erase(inside.back().conditions.begin() + static_cast<std::ptrdiff_t>(index));
    }
    return inside;
}

/** Another field stands for what the device cannot evaluate: the isosurface's own, or the volume's first one. */
void set_by_place_aside(Surface& surface, const RuntimeVolume& volume) {
    if (!is_by_place(surface.field, volume)) {
        return;
    }
    const SurfaceTraits traits = traits_of(surface.geometry);
    if (traits.wires == nullptr && !traits.has_own_values) {
        surface.by_place = surface.field;
    }
    const Isosurfaces* const isosurfaces = traits.isosurfaces;
    surface.field = isosurfaces != nullptr ? isosurfaces->field : FieldChoice{};
    if (isosurfaces == nullptr) {
        surface.field.component = volume.fields()[0].n_components > 1 ? -1 : 0;
        surface.field.offset = 0;
    }
}

/** Isosurfaces and conditions have the digits of differences from their values. */
void take_offsets(Surface& surface, std::uint32_t time_step, ShownFields& fields) {
    for (Condition& condition : surface.conditions) {
        condition.field = fields.about(condition.field, condition.value, time_step);
    }
    if (const Isosurfaces* const asked = traits_of(surface.geometry).isosurfaces) {
        Isosurfaces isosurfaces = *asked;
        const double middle = 0.5 * (isosurfaces.values.front() + isosurfaces.values.back());
        const bool is_own_color = surface.field == isosurfaces.field;
        isosurfaces.field = fields.about(isosurfaces.field, middle, time_step);
        surface.field = is_own_color ? isosurfaces.field : surface.field;
        surface.geometry = std::move(isosurfaces);
    }
}

} // namespace

void check_request(const FrameRequest& request, const RuntimeVolume& volume) {
    const std::uint64_t n_pixels = std::uint64_t{request.width} * request.height;
    if (n_pixels == 0 || n_pixels >= 0x7fffffffu) {
        throw Error("image", "a picture of " + std::to_string(request.width) + " x " + std::to_string(request.height) +
                                 " pixels cannot be drawn");
    }
    if (request.volume && volume.dimension() == 2) {
        throw Error(volume.path(), "is two-dimensional: there is no volume to be rendered");
    }
    for (const Surface& surface : request.surfaces) {
        check_surface(surface, volume);
        check_by_place(surface, volume);
    }
}

FrameRequest prepared(FrameRequest request, const RuntimeVolume& volume, ShownFields& fields) {
    const std::size_t n_asked = request.surfaces.size();
    for (std::size_t index = 0; index < n_asked; ++index) {
        std::ranges::move(boundary_inside(request.surfaces[index], volume), std::back_inserter(request.surfaces));
    }
    for (Surface& surface : request.surfaces) {
        set_by_place_aside(surface, volume);
        take_offsets(surface, request.time_step, fields);
    }
    return request;
}

std::vector<bool> met_as_asked(const FrameRequest& asked, const RuntimeVolume& volume, std::vector<bool> is_met) {
    const std::size_t n_asked = asked.surfaces.size();
    std::size_t added = n_asked;
    for (std::size_t index = 0; index < n_asked; ++index) {
        for (std::size_t n_left = boundary_inside(asked.surfaces[index], volume).size(); n_left > 0; --n_left, ++added) {
            is_met[index] = is_met[index] || is_met[added];
        }
    }
    is_met.resize(n_asked);
    return is_met;
}

} // namespace elvis
