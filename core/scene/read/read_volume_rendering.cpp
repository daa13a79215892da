#include <core/scene/read/read_parts.hpp>

#include <cstdio>

namespace elvis {

namespace {

/** Rows whose first numbers ascend. */
std::vector<std::vector<double>> ascending_rows(const JsonObject& object, const char* key) {
    std::vector<std::vector<double>> rows = object.rows(key);
    for (std::size_t i = 1; i < rows.size(); ++i) {
        if (rows[i][0] < rows[i - 1][0]) {
            char cause[100];
            std::snprintf(cause, sizeof cause, "has the value %.9g after %.9g; values must ascend", rows[i][0], rows[i - 1][0]);
            object.fail(std::string(key) + "[" + std::to_string(i) + "]", cause);
        }
    }
    return rows;
}

std::vector<TransferFunction::DensityPoint> read_density(const JsonObject& object) {
    std::vector<TransferFunction::DensityPoint> points;
    for (const std::vector<double>& row : ascending_rows(object, "density")) {
        points.push_back({row[0], row[1]});
    }
    return points;
}

ScenePeak read_peak(const JsonObject& object) {
    ScenePeak peak;
    peak.value = object.number("value");
    peak.width = object.number("width");
    peak.density = object.number("density");
    if (object.has("color")) {
        peak.color = fixed<3>(object.numbers("color"));
    }
    // Of a triangle narrower than doubles near its value can tell nothing would be left.
    if (!(peak.value - 0.5 * peak.width < peak.value && peak.value < peak.value + 0.5 * peak.width)) {
        object.fail("width", "is too small beside 'value': it is lost in rounding");
    }
    return peak;
}

void read_integrator(const JsonObject& object, SceneVolumeRendering& rendering) {
    if (object.has("integrator")) {
        rendering.integrator = integrator_named(object.word("integrator")).value();
    }
    if (object.has("step")) {
        rendering.step = object.number("step");
    }
    if (object.has("tolerance")) {
        rendering.tolerance = object.number("tolerance");
    }
    if (object.has("range_skipping")) {
        rendering.skips_by_range = object.flag("range_skipping");
    }
}

} // namespace

const std::vector<std::pair<std::string, Integrator>>& integrator_names() {
    static const std::vector<std::pair<std::string, Integrator>> names = {
        {"exact", Integrator::exact},
        {"riemann", Integrator::riemann},
        {"trapezoid", Integrator::trapezoid},
        {"categories", Integrator::categories},
        {"adaptive-trapezoid", Integrator::adaptive_trapezoid}};
    return names;
}

std::optional<Integrator> integrator_named(const std::string& name) {
    for (const auto& [known, integrator] : integrator_names()) {
        if (known == name) {
            return integrator;
        }
    }
    return {};
}

TransferFunction read_transfer(const JsonObject& object) {
    TransferFunction transfer;
    transfer.density = read_density(object);
    for (const std::vector<double>& row : ascending_rows(object, "color")) {
        transfer.color.push_back({row[0], {row[1], row[2], row[3]}});
    }
    return transfer;
}

SceneVolumeRendering read_volume_rendering(const JsonObject& object, const std::string& scene) {
    if (object.has("unit_distance") && !object.has("opacity")) {
        object.fail("unit_distance", "means nothing without 'opacity'");
    }
    SceneVolumeRendering rendering;
    if (object.has("field")) {
        rendering.field = object.text("field");
    }
    if (object.has("transfer")) {
        if (object.raw("transfer").is_string()) {
            rendering.transfer_file = beside(scene, object.text("transfer"));
        } else {
            rendering.transfer = read_transfer(object.object("transfer"));
        }
    }
    if (object.has("color_map")) {
        rendering.color_map = read_color_map(object.object("color_map"), scene);
    }
    if (object.has("density")) {
        rendering.density = read_density(object);
    }
    if (object.has("opacity")) {
        for (const std::vector<double>& row : ascending_rows(object, "opacity")) {
            rendering.opacity.push_back({row[0], row[1]});
        }
    }
    if (object.has("unit_distance")) {
        rendering.unit_distance = object.number("unit_distance");
    }
    if (object.has("peaks")) {
        for (const JsonObject& peak : object.objects("peaks")) {
            rendering.peaks.push_back(read_peak(peak));
        }
    }
    if (object.has("visible")) {
        rendering.is_shown = object.flag("visible");
    }
    read_integrator(object, rendering);
    return rendering;
}

} // namespace elvis
