#include <core/integrate/element_sums.hpp>

#include <core/probe/reference_shape.hpp>

#include <elvis/native/space.hpp>

#include <cmath>

namespace elvis {

namespace {

/** Columns of a Jacobian. */
struct Tangents {
    Vector3 first{}, second{}, third{};

    explicit Tangents(const double* jacobian)
        : first{jacobian[0], jacobian[3], jacobian[6]}, second{jacobian[1], jacobian[4], jacobian[7]}, third{jacobian[2],
                                                                                                             jacobian[5],
                                                                                                             jacobian[8]} {}

    double determinant() const { return dot(first, cross(second, third)); }
    /** A vector area from reference coordinates, turned round with an element that is inside out. */
    Vector3 area(const Vector3& v) const {
        const Vector3 area = plus(plus(scaled(cross(second, third), v[0]), scaled(cross(third, first), v[1])),
                                  scaled(cross(first, second), v[2]));
        return determinant() < 0 ? scaled(area, -1) : area;
    }
    Vector3 along(const Vector3& v) const { return plus(plus(scaled(first, v[0]), scaled(second, v[1])), scaled(third, v[2])); }
    /** Of an edge of a surface: as long as the edge, in the surface, out of the element, whose inside lies that way. */
    Vector3 conormal(const Vector3& edge, const Vector3& inside) const {
        const Vector3 normal = unit(cross(first, second)), across = cross(along(edge), normal);
        const Vector3 inward = plus(scaled(first, inside[0]), scaled(second, inside[1]));
        return dot(across, inward) > 0 ? scaled(across, -1) : across;
    }
};

Vector3 triple(const std::vector<double>& numbers, std::size_t index) {
    return {numbers[3 * index], numbers[3 * index + 1], numbers[3 * index + 2]};
}

/** A surface's middle, in reference coordinates. */
Vector3 middle_of(elvis_shape shape) { return shape == ELVIS_SHAPE_TRIANGLE ? Vector3{-1.0 / 3, -1.0 / 3, 0} : Vector3{}; }

} // namespace

Sums& Sums::operator+=(const Sums& other) {
    value += other.value;
    size += other.size;
    measure += other.measure;
    is_inverted = is_inverted || other.is_inverted;
    return *this;
}

Sums Integrand::sum(std::uint64_t element, elvis_shape shape, const ReferencePoints& points) const {
    const bool is_flat = native::dimension(native::Shape{shape}) == 2;
    const bool has_weights = !points.weights.empty();
    ElementSamples samples;
    if (points.size() > 0) {
        m_sampler.sample(element, points.xi, samples);
    }
    Sums sums;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Tangents tangents(&samples.jacobians[9 * i]);
        Vector3 area{};
        double measure = 0;
        if (has_weights) {
            const double determinant = is_flat ? length(cross(tangents.first, tangents.second)) : tangents.determinant();
            measure = points.weights[i] * std::abs(determinant);
            sums.is_inverted = sums.is_inverted || determinant < 0;
        } else {
            const Vector3 vector = triple(points.vectors, i);
            area = points.has_edges ? tangents.conormal(vector, minus(middle_of(shape), triple(points.xi, i)))
                                    : tangents.area(vector);
            measure = length(area);
            sums.is_inverted = sums.is_inverted || (!is_flat && tangents.determinant() < 0);
        }
        const double part = m_kind == Kind::one      ? measure
                            : m_kind == Kind::scalar ? measure * samples.values[i]
                                                     : dot(area, triple(samples.values, i));
        sums.value += part;
        sums.size += std::abs(part);
        sums.measure += measure;
    }
    return sums;
}

} // namespace elvis
