#include <core/base/vector3.hpp>
#include <core/expression/volume_point.hpp>
#include <core/probe/cpu_evaluator.hpp>
#include <core/probe/newton.hpp>

#include <algorithm>
#include <cassert>

namespace elvis {

CpuEvaluator::CpuEvaluator(const RuntimeVolume& volume) : m_volume(&volume) { assert(volume.has_evaluation()); }

elvis_shape CpuEvaluator::shape_of(std::uint64_t element) const {
    const auto& classes = m_volume->classes();
    const auto after = std::upper_bound(classes.begin(), classes.end(), element,
                                        [](std::uint64_t e, const ClassInfo& c) { return e < c.first_element; });
    return std::prev(after)->shape;
}

Inversion CpuEvaluator::invert(const InversionQuery& query) const {
    const MappingFunction mapping = [&](std::span<const double> xi, std::span<double> positions, std::span<double> jacobians) {
        m_volume->evaluate_mapping(query.element, xi, positions, jacobians);
    };
    return invert_mapping(shape_of(query.element), mapping, query.position);
}

std::vector<Inversion> CpuEvaluator::invert(std::span<const InversionQuery> queries) {
    std::vector<Inversion> answers;
    answers.reserve(queries.size());
    for (const InversionQuery& query : queries)
        answers.push_back(invert(query));
    return answers;
}

std::vector<FieldSample> CpuEvaluator::evaluate(std::uint32_t field, std::uint32_t time_step,
                                                std::span<const ReferencePoint> points) {
    const std::size_t n_components = m_volume->fields()[field].n_components;
    std::vector<FieldSample> samples;
    samples.reserve(points.size());
    Vector3 position{};
    std::array<double, 9> jacobian{};
    for (const ReferencePoint& point : points) {
        FieldSample sample;
        sample.values.resize(n_components);
        sample.gradients.resize(3 * n_components);
        m_volume->evaluate_field(field, time_step, point.element, point.xi, sample.values, sample.gradients);
        m_volume->evaluate_mapping(point.element, point.xi, position, jacobian);
        to_world_gradients(jacobian, sample.gradients);
        samples.push_back(std::move(sample));
    }
    return samples;
}

std::vector<ExpressionSample> CpuEvaluator::evaluate(const std::shared_ptr<const Expression>& expression,
                                                     std::uint32_t time_step, std::span<const ReferencePoint> points) {
    const bool is_exact = expression->gradient().has_value();
    std::vector<ExpressionSample> samples;
    samples.reserve(points.size());
    for (const ReferencePoint& point : points) {
        VolumePoint here(*m_volume, point.element, point.xi, time_step);
        const ValueAndGradient found =
            is_exact ? evaluate_gradient(*expression, here)
                     : ValueAndGradient{elvis::evaluate(*expression, here), here.differences(*expression)};
        std::vector<double> gradient(found.gradient.begin(), found.gradient.end());
        to_world_gradients(here.jacobian(), gradient);
        // On the CPU plugins give first derivatives alone.
        samples.push_back({found.value,
                           {gradient[0], gradient[1], gradient[2]},
                           expression->needs_second_derivatives(),
                           !is_exact || expression->gradient_needs_second_derivatives()});
    }
    return samples;
}

} // namespace elvis
