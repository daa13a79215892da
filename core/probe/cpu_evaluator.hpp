/**
 * @file cpu_evaluator.hpp
 * Point evaluation by the plugin's own functions for the CPU.
 */
#pragma once

#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/point_evaluator.hpp>

namespace elvis {

/** The volume must have CPU evaluation (RuntimeVolume::has_evaluation) and outlive this. */
class CpuEvaluator : public PointEvaluator {
public:
    explicit CpuEvaluator(const RuntimeVolume& volume);

    std::vector<Inversion> invert(std::span<const InversionQuery> queries) override;
    std::vector<FieldSample> evaluate(std::uint32_t field, std::uint32_t time_step,
                                      std::span<const ReferencePoint> points) override;
    std::vector<ExpressionSample> evaluate(const std::shared_ptr<const Expression>& expression, std::uint32_t time_step,
                                           std::span<const ReferencePoint> points) override;

private:
    elvis_shape shape_of(std::uint64_t element) const;
    Inversion invert(const InversionQuery& query) const;

    const RuntimeVolume* m_volume;
};

} // namespace elvis
