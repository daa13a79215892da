/**
 * @file device_evaluator.hpp
 * Point evaluation by the plugin's GLSL snippet on the device, in double precision: for plugins that have nothing else.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/point_evaluator.hpp>
#include <core/vulkan/device.hpp>

#include <memory>
#include <string>

namespace elvis {

/** The volume must outlive it. */
class DeviceEvaluator : public PointEvaluator {
public:
    /** `device` as for choose_device. An Error if the device has no double precision or the volume no field. */
    DeviceEvaluator(const RuntimeVolume& volume, const std::string& device);
    ~DeviceEvaluator() override;

    std::vector<Inversion> invert(std::span<const InversionQuery> queries) override;
    std::vector<FieldSample> evaluate(std::uint32_t field, std::uint32_t time_step,
                                      std::span<const ReferencePoint> points) override;

private:
    Device m_device;
    const RuntimeVolume* m_volume;
    /** Rounding of positions in world coordinates. */
    double m_position_error = 0;
};

} // namespace elvis
