/**
 * @file point_value_pass.hpp
 * Evaluates a field where a pass has found points of elements, for the samples of a picture.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/render/layer.hpp>
#include <core/volume/device_volume.hpp>

#include <memory>
#include <vector>

namespace elvis {

/** The kernels of one volume and field, one for each element class. Compiled when constructed. */
class PointValuePass {
public:
    PointValuePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    /** `points`: core_hit_point (shaders/library/hit_point.glsl) of each pixel whose surface is `first_surface` plus its class. */
    void draw(const Buffer& points, std::uint32_t first_surface, const ShownComponent& component, const LayerTarget& target,
              FrameCounts& counts);

private:
    /** By class; null where it is empty. */
    std::vector<std::unique_ptr<ComposedKernel>> m_kernels;
    Buffer m_counts;
};

} // namespace elvis
