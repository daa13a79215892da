#include <core/streamline/flow.hpp>

#include <core/base/error.hpp>
#include <core/expression/evaluate.hpp>
#include <core/expression/volume_point.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/probe/newton.hpp>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace elvis {

namespace {

/** A field of that name with components for a velocity. */
std::optional<std::uint32_t> plain_vector(const RuntimeVolume& volume, const std::string& name) {
    for (std::uint32_t index = 0; index < volume.fields().size(); ++index) {
        const FieldInfo& field = volume.fields()[index];
        if (field.name == name && (field.n_components == 3 || (field.n_components == 2 && volume.dimension() == 2))) {
            return index;
        }
    }
    return std::nullopt;
}

} // namespace

void need_evaluation(const RuntimeVolume& volume) {
    if (!volume.has_evaluation() || volume.is_cut()) {
        throw Error(volume.path(), "the plugin " + volume.plugin().id() +
                                       " does not evaluate whole elements on the CPU, along which streamlines are followed");
    }
}

Flow::Flow(const RuntimeVolume& volume, const std::string& field, std::uint32_t time_step)
    : m_volume(&volume), m_time_step(time_step), m_field(plain_vector(volume, field)) {
    if (m_field) {
        m_text = "'" + field + "'";
        return;
    }
    m_text = "(" + field + ")";
    const auto component = [&](const char* index) {
        return std::make_shared<const Expression>(m_text + index, volume.fields(), volume.dimension());
    };
    m_components = {component("[0]"), component("[1]"), nullptr};
    try {
        m_components[2] = component("[2]");
    } catch (const Error&) {
        if (volume.dimension() == 3) {
            throw;
        }
        m_components[2] = std::make_shared<const Expression>("0", volume.fields(), volume.dimension());
    }
}

Flow::Flow(const RuntimeVolume& volume, const std::string& field, FlowTimes times) : Flow(volume, field, 0) {
    m_times = std::move(times);
}

Flow Flow::reversed() const {
    Flow other = *this;
    other.m_sign = -m_sign;
    return other;
}

Flow Flow::with_spin() const {
    Flow other = *this;
    for (std::size_t i = 0; i < 3; ++i) {
        other.m_curl[i] = std::make_shared<const Expression>("curl(" + m_text + ")[" + std::to_string(i) + "]",
                                                             m_volume->fields(), m_volume->dimension());
    }
    return other;
}

elvis_shape Flow::shape_of(std::uint64_t element) const {
    const auto& classes = m_volume->classes();
    const auto after = std::upper_bound(classes.begin(), classes.end(), element,
                                        [](std::uint64_t e, const ClassInfo& c) { return e < c.first_element; });
    return std::prev(after)->shape;
}

bool Flow::is_one_at_a_time() const {
    const auto needs_facts = [](const auto& part) { return part && part->needs_element_facts(); };
    return std::ranges::any_of(m_components, needs_facts) || std::ranges::any_of(m_curl, needs_facts);
}

Vector3 Flow::at_step(const Components& components, const ReferencePoint& point, std::uint32_t time_step) const {
    Vector3 value{};
    if (!components[0]) {
        const std::size_t n_components = m_volume->fields()[*m_field].n_components;
        m_volume->evaluate_field(*m_field, time_step, point.element, point.xi, std::span(value).first(n_components), {});
    } else {
        VolumePoint here(*m_volume, point.element, point.xi, time_step);
        for (std::size_t i = 0; i < 3; ++i) {
            value[i] = evaluate(*components[i], here);
        }
    }
    return value;
}

Vector3 Flow::sum(const Components& components, const ReferencePoint& point, const TimeWeights& weights) const {
    Vector3 total{};
    for (std::size_t i = 0; i < weights.count; ++i) {
        // At a time step it is that step alone, whatever the others hold.
        if (weights.weights[i] != 0) {
            total = plus(total, scaled(at_step(components, point, weights.steps[i]), weights.weights[i]));
        }
    }
    return total;
}

Vector3 Flow::value(const Components& components, const ReferencePoint& point, double since) const {
    return is_steady() ? at_step(components, point, m_time_step)
                       : sum(components, point, m_times.course->at(m_times.start + m_sign * since));
}

FlowSample Flow::at(const ReferencePoint& point, double since) const {
    FlowSample sample;
    m_volume->evaluate_mapping(point.element, point.xi, sample.position, sample.jacobian);
    sample.velocity = scaled(value(m_components, point, since), m_sign);
    sample.slope = product(invert_matrix(sample.jacobian), sample.velocity);
    if (m_volume->dimension() == 2) {
        sample.slope[2] = 0;
    }
    const double speed = length(sample.velocity);
    if (m_curl[0] && speed > 0) {
        sample.spin = dot(value(m_curl, point, since), sample.velocity) / (2 * speed);
    }
    return sample;
}

std::optional<double> Flow::next_stop(double since) const {
    if (is_steady()) {
        return std::numeric_limits<double>::infinity();
    }
    const double now = m_times.start + m_sign * since;
    const double end = m_sign > 0 ? m_times.last : m_times.first;
    // Times that are told apart by rounding alone are one.
    if (m_sign * (end - now) <= shortest_time()) {
        return std::nullopt;
    }
    const std::optional<double> step = m_sign > 0 ? m_times.course->after(now) : m_times.course->before(now);
    const double next = step && m_sign * (*step - end) < 0 ? *step : end;
    return m_sign * (next - m_times.start);
}

std::optional<double> Flow::interpolation_doubt(const ReferencePoint& point, double since) const {
    if (is_steady()) {
        return std::nullopt;
    }
    const double middle = m_times.course->middle_about(m_times.start + m_sign * since);
    const std::optional<TimeWeights> weights = m_times.course->doubt_at(middle);
    return weights ? std::optional(length(sum(m_components, point, *weights))) : std::nullopt;
}

} // namespace elvis
