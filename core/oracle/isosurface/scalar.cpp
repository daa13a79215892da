#include "scalar.hpp"

#include <cmath>

namespace elvis::oracle {
namespace {

double magnitude(const Volume& volume, std::size_t element, const Vector& xi) {
    const std::vector<double> components = volume.field(element, xi);
    return Eigen::Map<const Eigen::VectorXd>(components.data(), static_cast<Eigen::Index>(components.size())).norm();
}

} // namespace

Scalar scalar_of_field(const Volume& volume, std::int32_t component) {
    if (component < 0)
        return with_differences(magnitude);
    const auto index = static_cast<std::size_t>(component);
    if (volume.transform() != native::Transform::none)
        return with_differences(
            [index](const Volume& v, std::size_t element, const Vector& xi) { return v.field(element, xi)[index]; });
    return [index](const Volume& v, std::size_t element, const Vector& xi, Vector* gradient) {
        return v.component(element, xi, index, gradient);
    };
}

Scalar with_differences(std::function<double(const Volume&, std::size_t, const Vector&)> value) {
    return [value = std::move(value)](const Volume& volume, std::size_t element, const Vector& xi, Vector* gradient) {
        if (gradient != nullptr)
            for (Eigen::Index d = 0; d < 3; ++d) {
                // Rounding leaves 1e-16 / step, the formula step^6 times the seventh derivative / 140.
                constexpr double step = 5e-3;
                const auto difference = [&](int n) {
                    const Vector offset = n * step * Vector::Unit(d);
                    return value(volume, element, xi + offset) - value(volume, element, xi - offset);
                };
                (*gradient)[d] = (45 * difference(1) - 9 * difference(2) + difference(3)) / (60 * step);
            }
        return value(volume, element, xi);
    };
}

} // namespace elvis::oracle
