/**
 * @file other_values.hpp
 * Where several elements hold the point that a pixel shows, whether it matters which of them is shown.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/shader/composer.hpp>
#include <core/volume/device_volume.hpp>

#include <memory>
#include <optional>
#include <vector>

namespace elvis {

/** For the passes of one field on cut surfaces. Kernels are compiled when they are first needed. */
class OtherValues {
public:
    OtherValues(const Device& device, const DeviceVolume& data) : m_device(device), m_data(data) {}

    /** An empty list for the kernel that draws pixels of a class (shaders/cut_surface/other_elements.glsl). */
    const Buffer& begin(std::uint64_t n_pixels, const ShownComponent& component);
    /** Marks pixels of the list whose other element has another value. */
    void compare(std::uint32_t element_class, const ShownComponent& component, const Layer& layer, FrameCounts& counts);

private:
    const ComposedKernel& kernel(std::uint32_t element_class);

    const Device& m_device;
    const DeviceVolume& m_data;
    std::vector<std::unique_ptr<ComposedKernel>> m_kernels;
    std::optional<Buffer> m_list;
};

} // namespace elvis
