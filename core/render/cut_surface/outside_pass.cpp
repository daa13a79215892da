#include <core/render/cut_surface/outside_pass.hpp>
#include <core/render/device/pixel_kernel.hpp>

namespace elvis {

namespace {

struct OutsideParameters {
    std::uint32_t n_pixels, groups_x;
    std::uint32_t width, surface;
    std::array<float, 6> box;
};

KernelRequest outside_kernel(Precision precision, bool on_plane) {
    KernelRequest request = pixel_kernel("cut_surface/surface_outside", precision,
                                         {.uniform = 1, .storage = on_plane ? 2u : 3u}, sizeof(OutsideParameters));
    request.defines.emplace_back("CORE_ON_PLANE", on_plane ? "1" : "0");
    return request;
}

} // namespace

OutsidePass::OutsidePass(const Device& device, Precision precision, bool on_plane)
    : m_kernel(device, outside_kernel(precision, on_plane)) {}

void OutsidePass::draw(const Buffer& frame, const Buffer* hits, std::uint32_t surface, const LayerTarget& target) const {
    const Layer& layer = target.layer;
    const auto n_pixels = static_cast<std::uint32_t>(layer.n_pixels());
    OutsideParameters parameters{n_pixels, pixel_groups_x, layer.width, surface, {}};
    for (std::size_t i = 0; i < m_box.size(); ++i) {
        parameters.box[i] = static_cast<float>(m_box[i]);
    }
    std::vector<const Buffer*> bindings = {&frame, &layer.samples, &layer.marks};
    if (hits != nullptr) {
        bindings.push_back(hits);
    }
    dispatch_pixels(m_kernel, bindings, std::as_bytes(std::span(&parameters, 1)), n_pixels);
}

std::array<double, 6> box_around(const std::array<double, 6>& volume) {
    std::array<double, 6> box{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double extent = volume[axis + 3] - volume[axis];
        box[axis] = volume[axis] - extent;
        box[axis + 3] = volume[axis + 3] + extent;
    }
    return box;
}

} // namespace elvis
