#include <core/located/located_fields.hpp>

#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/plugin_host/all_bounds.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/probe/newton.hpp>
#include <core/probe/plate.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace elvis {

namespace {

RuntimeVolume with_points(RuntimeVolume volume) {
    if (!volume.has_evaluation() || volume.is_cut()) {
        throw Error(volume.path(),
                    "the plugin " + volume.plugin().id() +
                        " does not evaluate whole elements on the CPU, in which points of another volume are found");
    }
    return volume;
}

void need_steps(const RuntimeVolume& volume, std::optional<std::uint32_t> time_step, std::size_t n_time_steps) {
    const std::size_t n = volume.times().size();
    if (time_step && *time_step >= n) {
        throw Error(volume.path(), "has " + counted(n, "time step") + ", no time step " + std::to_string(*time_step));
    }
    if (!time_step && n != 1 && n != n_time_steps) {
        throw Error(volume.path(), "has " + counted(n, "time step") + ", not " + std::to_string(n_time_steps) +
                                       ": which one is meant must be said");
    }
}

} // namespace

LocatedFields::LocatedFields(const std::string& name, RuntimeVolume other, std::optional<std::uint32_t> time_step,
                             std::size_t n_time_steps)
    : m_volume(with_points(std::move(other))), m_finder(m_volume), m_time_step(time_step), m_fields(m_volume.fields()) {
    need_steps(m_volume, time_step, n_time_steps);
    const std::vector<double> boxes = all_bounds(m_volume);
    for (std::size_t at = 0; at < boxes.size(); at += 6) {
        m_middles.push_back(
            scaled({boxes[at] + boxes[at + 3], boxes[at + 1] + boxes[at + 4], boxes[at + 2] + boxes[at + 5]}, 0.5));
    }
    for (FieldInfo& field : m_fields) {
        field.name = name + "." + field.name;
        // On faces of the other volume, which are anywhere.
        field.max_jump = std::numeric_limits<double>::quiet_NaN();
    }
}

std::uint32_t LocatedFields::step_of(std::uint32_t time_step) const {
    return m_time_step ? *m_time_step : m_volume.times().size() == 1 ? 0 : time_step;
}

/** Elements are tried from the most likely on: where a point is not, Newton's method takes long. */
std::vector<ReferencePoint> LocatedFields::places_of(const Vector3& position, double reach) const {
    std::vector<ReferencePoint> places;
    if (!std::isfinite(length(position))) {
        return places;
    }
    std::vector<std::uint32_t> elements;
    m_finder.append_near(position, elements, reach * m_finder.diagonal());
    std::ranges::sort(elements, {},
                      [&](std::uint32_t element) { return std::pair(length(minus(m_middles[element], position)), element); });
    for (const std::uint32_t element : elements) {
        const SolidElement solid(m_volume, element);
        const Inversion inversion = solid.invert(std::span(&position, 1)).front();
        const double excess = solid.excess(inversion.xi);
        if (inversion.outcome == Inversion::Outcome::inside || excess <= reach) {
            places.push_back({element, inversion.xi});
        }
        if (inversion.outcome == Inversion::Outcome::inside && (reach == 0 || excess < -reach)) {
            return {places.back()};
        }
    }
    return places;
}

void LocatedFields::evaluate(std::uint32_t field, std::uint32_t time_step, std::span<const double> positions,
                             std::span<double> values, std::span<double> gradients) const {
    const std::size_t n_components = m_fields[field].n_components;
    const auto some = [&](std::span<double> all, std::size_t point, std::size_t n) {
        return all.empty() ? all : all.subspan(point * n, n);
    };
    for (std::size_t point = 0; point < positions.size() / 3; ++point) {
        const Vector3 position{positions[3 * point], positions[3 * point + 1], positions[3 * point + 2]};
        const std::span<double> value = some(values, point, n_components), slopes = some(gradients, point, 3 * n_components);
        const std::vector<ReferencePoint> places = places_of(position, 0);
        if (places.empty()) {
            std::ranges::fill(value, std::numeric_limits<double>::quiet_NaN());
            std::ranges::fill(slopes, std::numeric_limits<double>::quiet_NaN());
            continue;
        }
        const ReferencePoint& at = places.front();
        m_volume.evaluate_field(field, step_of(time_step), at.element, at.xi, value, slopes);
        if (!slopes.empty()) {
            std::array<double, 9> jacobian{};
            m_volume.evaluate_mapping(at.element, at.xi, {}, jacobian);
            to_world_gradients(jacobian, slopes);
        }
    }
}

double LocatedFields::jump(std::uint32_t field, std::uint32_t time_step, const std::array<double, 3>& position,
                           double reach) const {
    const std::vector<ReferencePoint> places = places_of(position, reach);
    const std::size_t n_components = m_fields[field].n_components;
    std::vector<double> first(n_components), values(n_components);
    double apart = 0, largest = 0;
    for (std::size_t place = 0; places.size() > 1 && place < places.size(); ++place) {
        m_volume.evaluate_field(field, step_of(time_step), places[place].element, places[place].xi, values, {});
        first = place == 0 ? values : first;
        for (std::size_t component = 0; component < n_components; ++component) {
            apart = std::max(apart, std::abs(values[component] - first[component]));
            largest = std::max(largest, std::abs(values[component]));
        }
    }
    return largest > 0 ? apart / largest : 0;
}

} // namespace elvis
