#include <core/parts/fold_lic.hpp>

#include <core/base/bounds.hpp>
#include <core/render/picture/lic_pass.hpp>
#include <core/vulkan/real_array.hpp>

#include <cmath>
#include <span>

namespace elvis {

namespace {

/** The rays of the picture, anchored at the plane, or at the middle of the volume where there is none. */
CutPlaneGeometry view_of(const FrameRequest& alone, const std::array<double, 6>& bounds) {
    const Vector3 middle = middle_of(bounds), along = minus(alone.camera.look_at, alone.camera.eye);
    const CutPlane across{{along[0], along[1], along[2], -dot(along, middle)}};
    const CutPlane* const plane = traits_of(alone.surfaces[0].geometry).plane;
    return cut_plane_geometry(plane != nullptr ? *plane : across, alone.camera, alone.width, alone.height, middle);
}

template <class Real> void write_samples(const Frame& frame, const Layer& layer, bool with_marks) {
    std::vector<Sample<Real>> samples(layer.n_pixels());
    std::vector<Mark> marks(layer.n_pixels());
    for (std::size_t pixel = 0; pixel < samples.size(); ++pixel) {
        if (frame.element[pixel] >= 0) {
            samples[pixel] = {static_cast<Real>(frame.value[pixel]), static_cast<Real>(frame.depth[pixel]),
                              static_cast<std::uint32_t>(frame.element[pixel])};
            marks[pixel].owner = 1u << owner_bits;
        }
    }
    layer.samples.write_items(std::span<const Sample<Real>>(samples));
    if (with_marks) {
        layer.marks.write_items(std::span<const Mark>(marks));
    }
}

void write_layer(const Frame& frame, const Layer& layer, Precision precision, bool with_marks) {
    with_real(precision, [&]<class Real>(Real) { write_samples<Real>(frame, layer, with_marks); });
}

} // namespace

FrameRequest component_request(const FrameRequest& alone, std::size_t component) {
    FrameRequest request = alone;
    Surface& surface = request.surfaces[0];
    surface.field = surface.lic->vectors[component];
    surface.lic.reset();
    surface.contours.reset();
    surface.mesh_lines.reset();
    return request;
}

std::vector<double> shades_of(const Device& device, Precision precision, const FrameRequest& alone,
                              const std::array<Frame, 3>& components, const std::array<double, 6>& bounds, double error) {
    const DeviceTask task(device, nullptr);
    const Layer layer(device, precision, alone.width, alone.height), values(device, precision, alone.width, alone.height);
    LicPass pass(device, precision);
    write_layer(components[0], layer, precision, true);
    write_reals(layer.normals, precision, components[0].normal);
    pass.begin(layer, values);
    for (std::uint32_t component = 0; component < components.size(); ++component) {
        write_layer(components[component], values, precision, false);
        pass.take(layer, values, component);
    }
    const bool is_plane = traits_of(alone.surfaces[0].geometry).plane != nullptr;
    // Folded values are whole.
    pass.convolve(layer, view_of(alone, bounds), is_plane, {.offsets = {}, .error = error}, *alone.surfaces[0].lic,
                  alone.place().first_row);
    std::vector<double> shades = read_reals(pass.shades(), precision, layer.n_pixels());
    for (std::size_t pixel = 0; pixel < shades.size(); ++pixel) {
        shades[pixel] = components[0].element[pixel] >= 0 ? shades[pixel] : 1;
    }
    return shades;
}

} // namespace elvis
