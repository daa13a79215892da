#include "volume.hpp"

#include <Eigen/LU>

#include <algorithm>

namespace elvis::oracle {

Volume::Volume(VolumeData data) : m_data(std::move(data)) {
    for (std::size_t c = 0; c < m_data.classes.size(); ++c)
        for (std::size_t index = 0; index < m_data.classes[c].numbers.size(); ++index)
            m_elements.push_back({static_cast<std::uint32_t>(c), index});
}

std::int64_t Volume::number(std::size_t element) const { return class_of(element).numbers[m_elements[element].index]; }

std::span<const double> Volume::geometry_coefficients(std::size_t element) const {
    const ClassData& c = class_of(element);
    const std::size_t n = 3 * native::n_modes(c.geometry);
    return std::span(c.geometry_coefficients).subspan(m_elements[element].index * n, n);
}

Vector Volume::position(std::size_t element, const Vector& xi, Matrix* jacobian) const {
    const native::Space& space = class_of(element).geometry;
    const std::span<const double> coefficients = geometry_coefficients(element);
    const std::size_t n = native::n_modes(space);
    thread_local std::vector<double> values;
    thread_local std::vector<double> gradients;
    values.resize(n);
    // Far from the origin sums of coordinates lose more than a coordinate does: here they do not.
    Eigen::Matrix<long double, 3, 1> x = Eigen::Matrix<long double, 3, 1>::Zero();
    if (jacobian == nullptr) {
        native::evaluate_modes(space, {xi.x(), xi.y(), xi.z()}, values);
    } else {
        gradients.resize(3 * n);
        native::evaluate_modes(space, {xi.x(), xi.y(), xi.z()}, values, gradients);
        jacobian->setZero();
    }
    for (std::size_t mode = 0; mode < n; ++mode) {
        const Vector c(coefficients[mode], coefficients[n + mode], coefficients[2 * n + mode]);
        x += static_cast<long double>(values[mode]) * c.cast<long double>();
        if (jacobian != nullptr)
            *jacobian += c * Eigen::RowVector3d(gradients[3 * mode], gradients[3 * mode + 1], gradients[3 * mode + 2]);
    }
    return x.cast<double>();
}

double Volume::component(std::size_t element, const Vector& xi, std::size_t component, Vector* gradient) const {
    const ClassData& c = class_of(element);
    const std::size_t n = native::n_modes(c.field);
    const std::size_t first = (m_elements[element].index * m_data.n_components + component) * n;
    const auto coefficients = std::span(c.field_coefficients).subspan(first, n);
    const native::Point point{xi.x(), xi.y(), xi.z()};
    if (gradient == nullptr)
        return native::evaluate(c.field, coefficients, point);
    native::Point slope{};
    const double value = native::evaluate(c.field, coefficients, point, slope);
    *gradient = {slope[0], slope[1], slope[2]};
    return value;
}

std::vector<double> Volume::field(std::size_t element, const Vector& xi) const {
    std::vector<double> components(m_data.n_components);
    for (std::size_t i = 0; i < components.size(); ++i)
        components[i] = component(element, xi, i);
    if (m_data.transform != native::Transform::none) {
        Matrix jacobian;
        position(element, xi, &jacobian);
        const bool is_flat = components.size() == 2;
        if (is_flat)
            jacobian.col(2) = Vector::UnitZ();
        const Vector reference(components[0], components[1], is_flat ? 0 : components[2]);
        const Vector u = m_data.transform == native::Transform::covariant
                             ? Vector(jacobian.transpose().inverse() * reference)
                             : Vector(jacobian * reference / jacobian.determinant());
        std::copy_n(u.data(), components.size(), components.begin());
    }
    return components;
}

} // namespace elvis::oracle
