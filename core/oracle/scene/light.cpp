#include "light.hpp"

#include <core/oracle/picture/ray.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::oracle {

Color lit(const Lighting& lighting, const Color& color, const Vector& normal, const Vector& position, const Vector& to_viewer) {
    const Vector n = normal.dot(to_viewer) < 0 ? Vector(-normal) : normal;
    const Vector own(color[0], color[1], color[2]);
    Vector sum = own.cwiseProduct(vector_of(lighting.ambient));
    const auto add = [&](const Vector& to_light, const Vector& light) {
        const double diffuse = n.dot(to_light);
        if (!(diffuse > 0))
            return;
        const double cosine = n.dot((to_light + to_viewer).normalized());
        const double highlight = lighting.specular > 0 ? lighting.specular * std::pow(cosine, lighting.exponent) : 0;
        sum += light.cwiseProduct(Vector(diffuse * own + Vector::Constant(highlight)));
    };
    add(to_viewer, vector_of(lighting.headlight));
    for (const Light& light : lighting.lights) {
        const Vector at = vector_of(light.vector);
        add(light.type == Light::Type::point ? (at - position).normalized() : Vector(-at.normalized()), vector_of(light.color));
    }
    return {std::clamp(sum[0], 0.0, 1.0), std::clamp(sum[1], 0.0, 1.0), std::clamp(sum[2], 0.0, 1.0), color[3]};
}

} // namespace elvis::oracle
