/**
 * @file point_value_pass.hpp
 * Evaluates a field at the places in elements that another pass has found, for the samples of a picture.
 */
#pragma once

#include <core/render/frame.hpp>
#include <core/render/picture/layer.hpp>
#include <core/volume/device_volume.hpp>

#include <memory>
#include <vector>

namespace elvis {

/** The kernels of one volume and field, one for each element class. Compiled when constructed. */
class PointValuePass {
public:
    PointValuePass(const Device& device, const RuntimeVolume& volume, const DeviceVolume& data);

    /** For all pixels that show something; `target` has its places. Values go into `samples`, of the target's layer or another.
     */
    void draw(const ShownComponent& component, const LayerTarget& target, const Buffer& samples, FrameCounts& counts);

private:
    const Device& m_device;
    /** Of the classes that have elements. */
    std::vector<std::unique_ptr<ComposedKernel>> m_kernels;
    Buffer m_counts;
};

} // namespace elvis
