/**
 * @file device_evaluator.hpp
 * Point evaluation by the plugin's GLSL snippet on the device, in double precision: for plugins that have nothing else.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/point_evaluator.hpp>
#include <core/volume/device_volume.hpp>
#include <core/vulkan/device.hpp>

#include <string>

namespace elvis {

/** The volume must outlive it. */
class DeviceEvaluator : public PointEvaluator {
public:
    /** `device` as for choose_device. An Error if the device has no double precision or the volume no field. */
    DeviceEvaluator(const RuntimeVolume& volume, const std::string& device);

    std::vector<Inversion> invert(std::span<const InversionQuery> queries) override;
    std::vector<FieldSample> evaluate(std::uint32_t field, std::uint32_t time_step, std::span<const ReferencePoint> points,
                                      bool with_gradients) override;
    std::vector<ExpressionSample> evaluate(const std::shared_ptr<const Expression>& expression, std::uint32_t time_step,
                                           std::span<const ReferencePoint> points, bool with_gradients) override;

private:
    /**
     * Runs a kernel of one class with two storage buffers, input and output, over n_items invocations; its push constants end
     * with n_items (uint).
     */
    void run(const std::string& kernel, std::uint32_t element_class, std::span<const std::byte> parameters, const Buffer& input,
             const Buffer& output, std::size_t n_items) const;

    Device m_device;
    const RuntimeVolume* m_volume;
    DeviceVolume m_on_device;
    /** While one is evaluated. */
    const Expression* m_expression = nullptr;
    /** Rounding of positions in world coordinates. */
    double m_position_error = 0;
};

} // namespace elvis
