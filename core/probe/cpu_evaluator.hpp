/**
 * @file cpu_evaluator.hpp
 * Point evaluation by the plugin's own functions for the CPU.
 */
#pragma once

#include <core/base/background.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <core/probe/point_evaluator.hpp>

#include <cstdint>
#include <vector>

namespace elvis {

/** The volume must have CPU evaluation (RuntimeVolume::has_evaluation) and outlive this. Works on all processors. */
class CpuEvaluator : public PointEvaluator {
public:
    explicit CpuEvaluator(const RuntimeVolume& volume);

    bool is_for_any_thread() const override { return true; }
    std::vector<Inversion> invert(std::span<const InversionQuery> queries) override;
    std::vector<FieldSample> evaluate(std::uint32_t field, std::uint32_t time_step, std::span<const ReferencePoint> points,
                                      bool with_gradients) override;
    std::vector<ExpressionSample> evaluate(const std::shared_ptr<const Expression>& expression, std::uint32_t time_step,
                                           std::span<const ReferencePoint> points, bool with_gradients) override;

private:
    /** Of queries about one element, by their places in the list. */
    void invert_in(std::uint64_t element, std::span<const InversionQuery> queries, std::span<const std::size_t> places,
                   std::span<Inversion> answers);
    void evaluate_in(std::uint64_t element, std::uint32_t field, std::uint32_t time_step,
                     std::span<const ReferencePoint> points, std::span<const std::size_t> places, bool with_gradients,
                     std::span<FieldSample> samples) const;
    ExpressionSample sample_of(const Expression& expression, std::uint32_t time_step, const ReferencePoint& point,
                               bool with_gradients) const;

    const RuntimeVolume* m_volume;
    Background m_background;
};

} // namespace elvis
