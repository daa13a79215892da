#include <core/render/prepared_request.hpp>

#include <core/base/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace elvis {

namespace {

void check_values(const char* of, const std::vector<double>& values) {
    const bool are_finite = std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
    if (values.empty() || !are_finite || !std::ranges::is_sorted(values)) {
        throw Error(of, "needs finite values, in ascending order");
    }
}

void check_surface(const Surface& surface, const RuntimeVolume& volume) {
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

/** Isosurfaces are found with the digits that differences from their values have. */
void take_offset(Surface& surface, std::uint32_t time_step, ShownFields& fields) {
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
    }
}

FrameRequest prepared(FrameRequest request, const RuntimeVolume& volume, ShownFields& fields) {
    for (Surface& surface : request.surfaces) {
        take_offset(surface, request.time_step, fields);
    }
    const std::size_t n_asked = volume.is_cut() ? request.surfaces.size() : 0;
    for (std::size_t index = 0; index < n_asked; ++index) {
        if (traits_of(request.surfaces[index].geometry).is_whole_boundary) {
            Surface surface = request.surfaces[index];
            Isosurfaces own;
            own.field.is_own_boundary = true;
            own.values = {0};
            surface.geometry = own;
            request.surfaces.push_back(std::move(surface));
        }
    }
    return request;
}

std::vector<bool> met_as_asked(const FrameRequest& asked, std::vector<bool> is_met) {
    const std::size_t n_asked = asked.surfaces.size();
    for (std::size_t index = 0, added = n_asked; added < is_met.size(); ++index) {
        if (traits_of(asked.surfaces[index].geometry).is_whole_boundary) {
            is_met[index] = is_met[index] || is_met[added];
            ++added;
        }
    }
    is_met.resize(n_asked);
    return is_met;
}

} // namespace elvis
