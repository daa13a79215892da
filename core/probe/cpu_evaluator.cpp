#include <core/base/in_parts.hpp>
#include <core/base/vector3.hpp>
#include <core/expression/volume_point.hpp>
#include <core/probe/cpu_evaluator.hpp>
#include <core/probe/newton.hpp>
#include <core/probe/plate.hpp>

#include <algorithm>
#include <cassert>
#include <numeric>
#include <thread>

namespace elvis {

namespace {

/** So many that handing them over costs little, and that those of one element are together. */
constexpr std::uint64_t points_a_thread = 4096;

/** Places in a list of things in elements, in the order of these. */
template <class Thing> std::vector<std::size_t> by_element(std::span<const Thing> things) {
    std::vector<std::size_t> order(things.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return things[i].element; });
    return order;
}

/** Calls visit(element, its places) for each element of places in that order. */
template <class Thing, class Visit>
void for_each_element(std::span<const Thing> things, std::span<const std::size_t> order, const Visit& visit) {
    for (std::size_t first = 0; first < order.size();) {
        const std::uint64_t element = things[order[first]].element;
        std::size_t end = first;
        while (end < order.size() && things[order[end]].element == element)
            ++end;
        visit(element, order.subspan(first, end - first));
        first = end;
    }
}

} // namespace

CpuEvaluator::CpuEvaluator(const RuntimeVolume& volume)
    : m_volume(&volume), m_background(std::max(1u, std::thread::hardware_concurrency())) {
    assert(volume.has_evaluation());
}

void CpuEvaluator::invert_in(std::uint64_t element, std::span<const InversionQuery> queries,
                             std::span<const std::size_t> places, std::span<Inversion> answers) {
    std::vector<Vector3> targets;
    for (const std::size_t place : places)
        targets.push_back(queries[place].position);
    const std::vector<Inversion> found = SolidElement(*m_volume, element).invert(targets);
    for (std::size_t i = 0; i < places.size(); ++i)
        answers[places[i]] = found[i];
}

std::vector<Inversion> CpuEvaluator::invert(std::span<const InversionQuery> queries) {
    std::vector<Inversion> answers(queries.size());
    const std::vector<std::size_t> order = by_element(queries);
    in_parts(m_background, queries.size(), points_a_thread, [&](std::uint64_t first, std::uint64_t count) {
        for_each_element(
            queries, std::span(order).subspan(first, count),
            [&](std::uint64_t element, std::span<const std::size_t> places) { invert_in(element, queries, places, answers); });
    });
    return answers;
}

void CpuEvaluator::evaluate_in(std::uint64_t element, std::uint32_t field, std::uint32_t time_step,
                               std::span<const ReferencePoint> points, std::span<const std::size_t> places, bool with_gradients,
                               std::span<FieldSample> samples) const {
    const std::size_t n_components = m_volume->fields()[field].n_components,
                      n_gradients = with_gradients ? 3 * n_components : 0;
    std::vector<double> xi;
    for (const std::size_t place : places)
        xi.insert(xi.end(), points[place].xi.begin(), points[place].xi.end());
    std::vector<double> values(places.size() * n_components), gradients(places.size() * n_gradients);
    std::vector<double> positions(with_gradients ? xi.size() : 0), jacobians(3 * positions.size());
    m_volume->evaluate_field(field, time_step, element, xi, values, gradients);
    if (with_gradients)
        m_volume->evaluate_mapping(element, xi, positions, jacobians);
    for (std::size_t i = 0; i < places.size(); ++i) {
        FieldSample& sample = samples[places[i]];
        sample.values.assign(&values[i * n_components], &values[i * n_components] + n_components);
        if (with_gradients) {
            sample.gradients.assign(&gradients[i * n_gradients], &gradients[i * n_gradients] + n_gradients);
            std::array<double, 9> jacobian{};
            std::copy_n(&jacobians[9 * i], 9, jacobian.begin());
            to_world_gradients(jacobian, sample.gradients);
        }
    }
}

std::vector<FieldSample> CpuEvaluator::evaluate(std::uint32_t field, std::uint32_t time_step,
                                                std::span<const ReferencePoint> points, bool with_gradients) {
    std::vector<FieldSample> samples(points.size());
    const std::vector<std::size_t> order = by_element(points);
    in_parts(m_background, points.size(), points_a_thread, [&](std::uint64_t first, std::uint64_t count) {
        for_each_element(points, std::span(order).subspan(first, count),
                         [&](std::uint64_t element, std::span<const std::size_t> places) {
                             evaluate_in(element, field, time_step, points, places, with_gradients, samples);
                         });
    });
    return samples;
}

ExpressionSample CpuEvaluator::sample_of(const Expression& expression, std::uint32_t time_step, const ReferencePoint& point,
                                         bool with_gradients) const {
    // On the CPU plugins give first derivatives alone.
    const bool is_exact = expression.gradient().has_value();
    ExpressionSample sample{
        0, {}, expression.needs_second_derivatives(), !is_exact || expression.gradient_needs_second_derivatives()};
    VolumePoint here(*m_volume, point.element, point.xi, time_step);
    if (!with_gradients) {
        sample.value = elvis::evaluate(expression, here);
        return sample;
    }
    const ValueAndGradient found = is_exact ? evaluate_gradient(expression, here)
                                            : ValueAndGradient{elvis::evaluate(expression, here), here.differences(expression)};
    sample.value = found.value;
    sample.gradient = found.gradient;
    to_world_gradients(here.jacobian(), sample.gradient);
    return sample;
}

std::vector<ExpressionSample> CpuEvaluator::evaluate(const std::shared_ptr<const Expression>& expression,
                                                     std::uint32_t time_step, std::span<const ReferencePoint> points,
                                                     bool with_gradients) {
    std::vector<ExpressionSample> samples(points.size());
    const std::uint64_t part = expression->needs_element_facts() ? std::max<std::uint64_t>(1, points.size()) : points_a_thread;
    in_parts(m_background, points.size(), part, [&](std::uint64_t first, std::uint64_t count) {
        for (std::uint64_t i = first; i < first + count; ++i)
            samples[i] = sample_of(*expression, time_step, points[i], with_gradients);
    });
    return samples;
}

} // namespace elvis
