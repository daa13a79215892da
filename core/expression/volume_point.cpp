#include <core/base/vector3.hpp>
#include <core/expression/glsl.hpp>
#include <core/expression/volume_point.hpp>

#include <algorithm>

namespace elvis {

namespace {

/**
 * Of central differences of sixth order, which are exact for polynomials up to order 6. Their rounding is about 2e-14 of a
 * first derivative; the points lie at most 0.03 outside the element, where the plugin has its natural extension.
 */
constexpr double spacing = 0.01;

} // namespace

VolumePoint::VolumePoint(const RuntimeVolume& volume, std::uint64_t element, const Vector3& xi, std::uint32_t time_step)
    : m_volume(volume), m_element(element), m_xi(xi), m_time_step(time_step) {
    m_volume.evaluate_mapping(element, xi, m_position, m_jacobian);
}

std::vector<double> VolumePoint::differences(const std::function<std::vector<double>(const Vector3&)>& function) const {
    constexpr std::array<double, 3> weights{45.0 / 60, -9.0 / 60, 1.0 / 60};
    std::vector<double> result;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<double> sum;
        for (int step = -3; step <= 3; ++step) {
            if (step == 0) {
                continue;
            }
            Vector3 at = m_xi;
            at[axis] += step * spacing;
            const std::vector<double> numbers = function(at);
            sum.resize(numbers.size());
            const double weight = (step < 0 ? -1 : 1) * weights[static_cast<std::size_t>(std::abs(step)) - 1] / spacing;
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                sum[i] += weight * numbers[i];
            }
        }
        result.insert(result.end(), sum.begin(), sum.end());
    }
    return result;
}

Vector3 VolumePoint::differences(const Expression& expression) const {
    const std::vector<double> by_axis = differences([&](const Vector3& xi) {
        VolumePoint there(m_volume, m_element, xi, m_time_step);
        return std::vector<double>{evaluate(expression, there)};
    });
    return {by_axis[0], by_axis[1], by_axis[2]};
}

std::array<double, 27> VolumePoint::mapping_hessian() {
    const std::vector<double> by_axis = differences([this](const Vector3& xi) {
        std::vector<double> position(3), jacobian(9);
        m_volume.evaluate_mapping(m_element, xi, position, jacobian);
        return jacobian;
    });
    std::array<double, 27> result{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            for (std::size_t l = 0; l < 3; ++l) {
                result[9 * i + 3 * j + l] = 0.5 * (by_axis[9 * l + 3 * i + j] + by_axis[9 * j + 3 * i + l]);
            }
        }
    }
    return result;
}

VolumePoint::Sample& VolumePoint::sample(std::uint32_t field) {
    const auto [found, is_new] = m_samples.try_emplace(field);
    if (is_new) {
        const std::size_t n_components = m_volume.fields()[field].n_components;
        found->second.values.resize(n_components);
        found->second.gradients.resize(3 * n_components);
        m_volume.evaluate_field(field, m_time_step, m_element, m_xi, found->second.values, found->second.gradients);
    }
    return found->second;
}

Vector3 VolumePoint::gradient(std::uint32_t field, std::uint32_t component) {
    const std::vector<double>& gradients = sample(field).gradients;
    return {gradients[3 * component], gradients[3 * component + 1], gradients[3 * component + 2]};
}

std::array<double, 9> VolumePoint::hessian(std::uint32_t field, std::uint32_t component) {
    std::optional<std::vector<double>>& hessians = sample(field).hessians;
    const std::size_t n = 3 * std::size_t{m_volume.fields()[field].n_components};
    if (!hessians) {
        hessians = differences([&](const Vector3& xi) {
            std::vector<double> values(n / 3), gradients(n);
            m_volume.evaluate_field(field, m_time_step, m_element, xi, values, gradients);
            return gradients;
        });
    }
    std::array<double, 9> result{};
    for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t l = 0; l < 3; ++l) {
            result[3 * j + l] = 0.5 * ((*hessians)[n * l + 3 * component + j] + (*hessians)[n * j + 3 * component + l]);
        }
    }
    return result;
}

std::uint32_t VolumePoint::element_class() const {
    std::uint32_t index = 0;
    while (m_element - m_volume.classes()[index].first_element >= m_volume.classes()[index].n_elements) {
        ++index;
    }
    return index;
}

double VolumePoint::order(std::uint32_t field) {
    const std::vector<std::int32_t> orders = expression_class(m_volume, element_class()).orders;
    return field == any_field ? *std::max_element(orders.begin(), orders.end()) : orders[field];
}

double VolumePoint::element_number() {
    std::int64_t number = 0;
    m_volume.element_numbers(m_element, 1, std::span(&number, 1));
    return static_cast<double>(number);
}

} // namespace elvis
