#include <core/session/volume/field_samples.hpp>

#include <core/base/error.hpp>
#include <core/base/vector3.hpp>
#include <core/expression/expression.hpp>
#include <core/scene/frame_request.hpp>
#include <core/scene/surface_distance.hpp>
#include <core/volume/element/flat_height.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace elvis {

void need_samples(const RuntimeVolume& volume) {
    if (volume.dimension() == 2 && !flat_height(volume)) {
        throw Error(volume.path(), "is a surface in space, where random points are none of its own: it cannot be sampled");
    }
}

std::vector<double> field_samples(Prober& prober, const RuntimeVolume& volume, const std::array<double, 6>& bounds,
                                  const Scene& scene, const std::optional<std::string>& field, unsigned piece) {
    const std::string text = with_distances(field.value_or(volume.fields().at(0).name), scene.surfaces);
    const FieldChoice choice = choose_field(volume, text);
    ProbeWishes wishes{std::vector<bool>(volume.fields().size(), false), {}, false};
    if (choice.expression) {
        wishes.expressions.push_back(choice.expression);
    } else {
        (*wishes.fields)[choice.field] = true;
    }
    std::mt19937 random(piece + 1);
    std::vector<Vector3> positions(n_points_a_piece);
    for (auto& position : positions) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            position[axis] = std::uniform_real_distribution<double>(bounds[axis], bounds[axis + 3])(random);
        }
    }
    std::vector<double> values;
    for (const ProbedPoint& point : prober.probe(positions, scene.time_step, wishes)) {
        if (!point.element) {
            continue;
        }
        if (choice.expression) {
            values.push_back(point.expressions[0].value);
            continue;
        }
        const std::vector<double>& components = point.fields[choice.field].values;
        double value = 0;
        for (const double component : components) {
            value = std::hypot(value, component);
        }
        values.push_back(choice.component < 0 ? value : components[static_cast<std::size_t>(choice.component)]);
    }
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    return values;
}

std::vector<double> percentiles(Prober& prober, const RuntimeVolume& volume, const std::array<double, 6>& bounds,
                                const Scene& scene, std::span<const double> parts, const TaskControl& control) {
    Scene at_step = scene;
    std::vector<double> values;
    for (const std::uint32_t step : scene.range_steps.empty() ? std::vector{scene.time_step} : scene.range_steps) {
        at_step.time_step = step;
        for (unsigned piece = 0; piece < n_pieces; ++piece) {
            control.check();
            const std::vector<double> some = field_samples(prober, volume, bounds, at_step, scene.field, piece);
            values.insert(values.end(), some.begin(), some.end());
        }
    }
    if (values.empty()) {
        throw Error("percentiles", "are of finite values at points in elements, and none was found");
    }
    std::ranges::sort(values);
    std::vector<double> result;
    for (const double part : parts) {
        result.push_back(quantile(values, part));
    }
    return result;
}

} // namespace elvis
