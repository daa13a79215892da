#include <core/render/picture/lighting.hpp>

#include <cmath>

namespace elvis {

namespace {

using Row = std::array<double, 3>;

void append(std::vector<double>& rows, const Row& xyz, double w) { rows.insert(rows.end(), {xyz[0], xyz[1], xyz[2], w}); }

bool is_black(const Row& color) { return color[0] == 0 && color[1] == 0 && color[2] == 0; }

} // namespace

std::vector<double> lighting_rows(const Lighting& lighting, const std::array<double, 3>& reference) {
    constexpr double at_eye = 0, from_direction = 1, from_place = 2;
    std::vector<double> lights;
    if (!is_black(lighting.headlight)) {
        append(lights, {}, at_eye);
        append(lights, lighting.headlight, 0);
    }
    for (const Light& light : lighting.lights) {
        if (light.type == Light::Type::point) {
            append(lights, {light.vector[0] - reference[0], light.vector[1] - reference[1], light.vector[2] - reference[2]},
                   from_place);
        } else {
            // Towards the light.
            const double length = std::hypot(light.vector[0], light.vector[1], light.vector[2]);
            append(lights, {-light.vector[0] / length, -light.vector[1] / length, -light.vector[2] / length}, from_direction);
        }
        append(lights, light.color, 0);
    }
    std::vector<double> rows;
    append(rows, lighting.ambient, static_cast<double>(lights.size() / 8));
    append(rows, {lighting.specular, lighting.exponent, 0}, 0);
    rows.insert(rows.end(), lights.begin(), lights.end());
    return rows;
}

} // namespace elvis
