/**
 * @file evaluator.hpp
 * Position and field at points of one element, from the plugin's CPU functions or, where it has none, from its snippet on the
 * device in double precision.
 */
#pragma once

#include <core/conformance/check.hpp>
#include <core/conformance/device_sampler.hpp>
#include <core/conformance/reference_points.hpp>

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace elvis::conformance {

class Evaluator {
public:
    /** The volume must outlive it. */
    Evaluator(Context& context, const RuntimeVolume& volume);

    const char* name() const { return m_device ? "the snippet in double precision" : "the plugin's own evaluation"; }

    std::vector<Point> positions(std::uint64_t element, const std::vector<Point>& xi) const;

    /** Before values(). */
    void select(std::uint32_t field);

    /** Value and gradient of a component of the selected field. */
    std::vector<std::pair<double, Point>> values(std::uint64_t element, const std::vector<Point>& xi,
                                                 std::uint32_t component) const;

private:
    const RuntimeVolume& m_volume;
    std::unique_ptr<DeviceSampler> m_device;
    std::uint32_t m_field = 0;
};

} // namespace elvis::conformance
