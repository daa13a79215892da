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
    std::array<double, 3> position{};
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

} // namespace elvis
