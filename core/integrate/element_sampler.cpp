#include <core/integrate/element_sampler.hpp>

#include <core/expression/evaluate.hpp>
#include <core/expression/volume_point.hpp>

#include <algorithm>
#include <cassert>
#include <optional>

namespace elvis {

/** One of the points, for expressions: what many share has been evaluated for all of them; the rest is asked for here. */
class ElementSampler::Point : public ExpressionPoint {
public:
    Point(const RuntimeVolume& volume, std::uint64_t element, std::span<const double> xi, std::uint32_t time_step,
          const ElementSamples& samples, const std::vector<FieldSamples>& fields)
        : m_volume(volume), m_element(element), m_all_xi(xi), m_time_step(time_step), m_samples(samples), m_fields(fields) {}

    void go_to(std::size_t point) {
        m_at = point;
        m_rare.reset();
    }

    Vector3 position() override {
        return {m_samples.positions[3 * m_at], m_samples.positions[3 * m_at + 1], m_samples.positions[3 * m_at + 2]};
    }
    std::array<double, 9> jacobian() override {
        std::array<double, 9> matrix{};
        std::copy_n(&m_samples.jacobians[9 * m_at], 9, matrix.begin());
        return matrix;
    }
    std::array<double, 27> mapping_hessian() override { return rare().mapping_hessian(); }
    double value(std::uint32_t field, std::uint32_t component) override {
        return m_fields[field].values[m_at * m_volume.fields()[field].n_components + component];
    }
    Vector3 gradient(std::uint32_t field, std::uint32_t component) override {
        const std::size_t at = 3 * (m_at * m_volume.fields()[field].n_components + component);
        const std::vector<double>& gradients = m_fields[field].gradients;
        return {gradients[at], gradients[at + 1], gradients[at + 2]};
    }
    std::array<double, 9> hessian(std::uint32_t field, std::uint32_t component) override {
        return rare().hessian(field, component);
    }
    double order(std::uint32_t field) override { return rare().order(field); }
    double element_number() override { return rare().element_number(); }

private:
    VolumePoint& rare() {
        if (!m_rare) {
            m_rare.emplace(m_volume, m_element, Vector3{m_all_xi[3 * m_at], m_all_xi[3 * m_at + 1], m_all_xi[3 * m_at + 2]},
                           m_time_step);
        }
        return *m_rare;
    }

    const RuntimeVolume& m_volume;
    std::uint64_t m_element;
    std::span<const double> m_all_xi;
    std::uint32_t m_time_step;
    const ElementSamples& m_samples;
    const std::vector<FieldSamples>& m_fields;
    std::size_t m_at = 0;
    std::optional<VolumePoint> m_rare;
};

ElementSampler::ElementSampler(const RuntimeVolume& volume, std::vector<std::shared_ptr<const Expression>> expressions,
                               std::uint32_t time_step)
    : m_volume(volume), m_expressions(std::move(expressions)), m_time_step(time_step),
      m_reads_value(volume.fields().size(), false), m_reads_gradient(volume.fields().size(), false) {
    assert(volume.has_evaluation());
    for (const auto& expression : m_expressions) {
        m_reads_mapping = m_reads_mapping || !expression->plain();
        for (const std::uint32_t field : expression->fields()) {
            m_reads_value[field] = true;
            m_reads_gradient[field] = m_reads_gradient[field] || expression->needs_gradients();
        }
    }
}

std::vector<ElementSampler::FieldSamples> ElementSampler::fields_at(std::uint64_t element, std::span<const double> xi,
                                                                    bool with_slopes) const {
    std::vector<FieldSamples> fields(m_volume.fields().size());
    for (std::uint32_t field = 0; field < fields.size(); ++field) {
        if (!m_reads_value[field]) {
            continue;
        }
        const std::size_t n_values = xi.size() / 3 * m_volume.fields()[field].n_components;
        fields[field].values.resize(n_values);
        fields[field].gradients.resize(with_slopes || m_reads_gradient[field] ? 3 * n_values : 0);
        m_volume.evaluate_field(field, m_time_step, element, xi, fields[field].values, fields[field].gradients);
    }
    return fields;
}

void ElementSampler::sample(std::uint64_t element, std::span<const double> xi, ElementSamples& samples) const {
    sample_mapping(element, xi, samples);
    sample_expressions(element, xi, false, samples);
}

void ElementSampler::sample_slopes(std::uint64_t element, std::span<const double> xi, ElementSamples& samples) const {
    if (m_reads_mapping) {
        sample_mapping(element, xi, samples);
    }
    sample_expressions(element, xi, true, samples);
}

void ElementSampler::sample_mapping(std::uint64_t element, std::span<const double> xi, ElementSamples& samples) const {
    samples.positions.resize(xi.size());
    samples.jacobians.resize(3 * xi.size());
    m_volume.evaluate_mapping(element, xi, samples.positions, samples.jacobians);
}

void ElementSampler::sample_expressions(std::uint64_t element, std::span<const double> xi, bool with_slopes,
                                        ElementSamples& samples) const {
    const std::size_t n_points = xi.size() / 3;
    samples.values.resize(n_points * m_expressions.size());
    samples.slopes.resize(with_slopes ? 3 * samples.values.size() : 0);
    if (m_expressions.empty()) {
        return;
    }
    const std::vector<FieldSamples> fields = fields_at(element, xi, with_slopes);
    Point here(m_volume, element, xi, m_time_step, samples, fields);
    for (std::size_t point = 0, at = 0; point < n_points; ++point) {
        here.go_to(point);
        for (const auto& expression : m_expressions) {
            const std::optional<Expression::PlainField>& plain = expression->plain();
            const bool is_component = plain && plain->component >= 0;
            if (is_component) {
                samples.values[at] = here.value(plain->field, static_cast<std::uint32_t>(plain->component));
            } else if (!with_slopes) {
                samples.values[at] = evaluate(*expression, here);
            }
            if (with_slopes) {
                const ValueAndGradient found =
                    is_component ? ValueAndGradient{samples.values[at],
                                                    here.gradient(plain->field, static_cast<std::uint32_t>(plain->component))}
                                 : evaluate_gradient(*expression, here);
                samples.values[at] = found.value;
                std::copy(found.gradient.begin(), found.gradient.end(), &samples.slopes[3 * at]);
            }
            ++at;
        }
    }
}

} // namespace elvis
