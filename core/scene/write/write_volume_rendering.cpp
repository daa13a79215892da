#include <core/scene/write/write_parts.hpp>

namespace elvis {

namespace {

SceneJson density_json(const std::vector<TransferFunction::DensityPoint>& points) {
    SceneJson json = SceneJson::array();
    for (const TransferFunction::DensityPoint& point : points) {
        json.push_back({point.value, point.density});
    }
    return json;
}

SceneJson transfer_json(const TransferFunction& transfer) {
    SceneJson json;
    json["color"] = SceneJson::array();
    for (const TransferFunction::ColorPoint& point : transfer.color) {
        json["color"].push_back({point.value, point.rgb[0], point.rgb[1], point.rgb[2]});
    }
    json["density"] = density_json(transfer.density);
    return json;
}

} // namespace

SceneJson volume_rendering_json(const SceneVolumeRendering& rendering, const std::string& scene) {
    SceneJson json = SceneJson::object();
    if (rendering.field) {
        json["field"] = *rendering.field;
    }
    if (!rendering.transfer_file.empty()) {
        json["transfer"] = seen_from(scene, rendering.transfer_file);
    } else if (rendering.transfer) {
        json["transfer"] = transfer_json(*rendering.transfer);
    }
    if (rendering.color_map) {
        json["color_map"] = color_map_json(*rendering.color_map, scene);
    }
    if (!rendering.density.empty()) {
        json["density"] = density_json(rendering.density);
    }
    for (const OpacityPoint& point : rendering.opacity) {
        json["opacity"].push_back({point.value, point.opacity});
    }
    if (!rendering.opacity.empty()) {
        json["unit_distance"] = rendering.unit_distance;
    }
    for (const ScenePeak& peak : rendering.peaks) {
        SceneJson one{{"value", peak.value}, {"width", peak.width}, {"density", peak.density}};
        if (peak.color) {
            one["color"] = *peak.color;
        }
        json["peaks"].push_back(std::move(one));
    }
    for (const auto& [name, integrator] : integrator_names()) {
        if (integrator == rendering.integrator) {
            json["integrator"] = name;
        }
    }
    if (has_steps(rendering.integrator)) {
        if (rendering.step) {
            json["step"] = *rendering.step;
        }
    } else {
        json["tolerance"] = rendering.tolerance;
    }
    if (!rendering.skips_by_range) {
        json["range_skipping"] = false;
    }
    if (!rendering.is_shown) {
        json["visible"] = false;
    }
    return json;
}

} // namespace elvis
