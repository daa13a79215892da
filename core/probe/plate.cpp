#include <core/probe/plate.hpp>
#include <core/probe/reference_shape.hpp>

#include <algorithm>
#include <cmath>

namespace elvis {

namespace {

elvis_shape shape_of(const RuntimeVolume& volume, std::uint64_t element) {
    const auto& classes = volume.classes();
    const auto after = std::upper_bound(classes.begin(), classes.end(), element,
                                        [](std::uint64_t e, const ClassInfo& c) { return e < c.first_element; });
    return std::prev(after)->shape;
}

elvis_shape solid_of(elvis_shape shape) {
    return shape == ELVIS_SHAPE_QUADRILATERAL ? ELVIS_SHAPE_HEXAHEDRON
           : shape == ELVIS_SHAPE_TRIANGLE    ? ELVIS_SHAPE_PRISM
                                              : shape;
}

/** Its longest tangent, at the first corner. */
double size_of(const RuntimeVolume& volume, std::uint64_t element) {
    const Vector3 corner{-1, -1, 0};
    std::array<double, 9> jacobian{};
    volume.evaluate_mapping(element, corner, {}, jacobian);
    const Vector3 first{jacobian[0], jacobian[3], jacobian[6]}, second{jacobian[1], jacobian[4], jacobian[7]};
    return std::max(length(first), length(second));
}

} // namespace

SolidElement::SolidElement(const RuntimeVolume& volume, std::uint64_t element)
    : m_volume(volume), m_element(element), m_shape(shape_of(volume, element)), m_solid_shape(solid_of(m_shape)) {
    if (is_plate()) {
        m_size = size_of(volume, element);
    }
}

Vector3 SolidElement::own(const Vector3& solid) const {
    return !is_plate()                       ? solid
           : m_shape == ELVIS_SHAPE_TRIANGLE ? Vector3{solid[0], solid[2], 0}
                                             : Vector3{solid[0], solid[1], 0};
}

Vector3 SolidElement::solid(const Vector3& own) const {
    return !is_plate() ? own : m_shape == ELVIS_SHAPE_TRIANGLE ? Vector3{own[0], 0, own[1]} : Vector3{own[0], own[1], 0};
}

MappingFunction SolidElement::mapping() const {
    return [this](std::span<const double> xi, std::span<double> positions, std::span<double> jacobians) {
        if (is_plate()) {
            evaluate_plate(xi, positions, jacobians);
        } else {
            m_volume.evaluate_mapping(m_element, xi, positions, jacobians);
        }
    };
}

// How normals turn is left out of the Jacobian: near the element it does not count.
void SolidElement::evaluate_plate(std::span<const double> xi, std::span<double> positions, std::span<double> jacobians) const {
    const std::size_t n_points = xi.size() / 3, normal = normal_axis(), second = 3 - normal;
    std::vector<double> own_xi, own_jacobians(9 * n_points);
    for (std::size_t point = 0; point < n_points; ++point) {
        const Vector3 at = own({xi[3 * point], xi[3 * point + 1], xi[3 * point + 2]});
        own_xi.insert(own_xi.end(), at.begin(), at.end());
    }
    m_volume.evaluate_mapping(m_element, own_xi, positions, own_jacobians);
    for (std::size_t point = 0; point < n_points; ++point) {
        for (std::size_t row = 0; row < 3; ++row) {
            const double* const from = &own_jacobians[9 * point + 3 * row];
            const double along_normal = m_size * from[2];
            positions[3 * point + row] += xi[3 * point + normal] * along_normal;
            if (!jacobians.empty()) {
                double* const to = &jacobians[9 * point + 3 * row];
                to[0] = from[0];
                to[second] = from[1];
                to[normal] = along_normal;
            }
        }
    }
}

double SolidElement::excess(const Vector3& own) const { return reference_excess(m_shape, own); }

std::vector<Inversion> SolidElement::invert(std::span<const Vector3> targets) const {
    std::vector<Inversion> found = invert_mapping(m_solid_shape, mapping(), targets);
    if (!is_plate()) {
        return found;
    }
    for (Inversion& inversion : found) {
        if (!(std::abs(inversion.xi[normal_axis()]) <= on_surface)) {
            // Beside its face, if anything.
            const bool has_failed = inversion.outcome == Inversion::Outcome::failed;
            inversion = {has_failed ? Inversion::Outcome::failed : Inversion::Outcome::outside, nowhere};
        }
        inversion.xi = own(inversion.xi);
    }
    return found;
}

} // namespace elvis
