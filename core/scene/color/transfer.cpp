#include <core/scene/color/transfer.hpp>

#include <core/scene/color/color_map.hpp>

#include <cmath>

namespace elvis {

namespace {

std::array<double, 3> rgb_of(const Color& color) { return {color[0], color[1], color[2]}; }

std::vector<TransferFunction::ColorPoint> colors_of(const SceneColorMap& map, const std::array<double, 2>& range) {
    const ColorTable table = make_color_table(map, range, volume_table_tolerance);
    std::vector<TransferFunction::ColorPoint> points;
    if (map.is_logarithmic) {
        points.push_back({0, rgb_of(table.nan)});
        points.push_back({0, rgb_of(table.below)});
    }
    if (const auto below = rgb_of(table.below); below != table.points.front().rgb) {
        points.push_back({table.points.front().value, below});
    }
    for (const ColorTable::Point& point : table.points) {
        points.push_back({point.value, point.rgb});
    }
    if (const auto above = rgb_of(table.above); above != table.points.back().rgb) {
        points.push_back({table.points.back().value, above});
    }
    return points;
}

std::vector<TransferFunction::DensityPoint> density_of(const SceneVolumeRendering& scene, bool is_logarithmic,
                                                       const std::array<double, 2>& range, double diagonal) {
    if (!scene.density.empty()) {
        return scene.density;
    }
    if (!scene.opacity.empty()) {
        return density_from_opacity(scene.opacity, scene.unit_distance);
    }
    if (!scene.has_default_density()) {
        return {};
    }
    const double top = default_density(diagonal);
    if (is_logarithmic && range[0] < range[1]) {
        // To a thousandth of what is densest.
        const ColorScale scale(range, true);
        const std::uint32_t n_parts = logarithmic_parts(std::log(range[1]) - std::log(range[0]), 1, 1e-3);
        std::vector<TransferFunction::DensityPoint> points;
        for (std::uint32_t part = 0; part <= n_parts; ++part) {
            const double t = static_cast<double>(part) / n_parts;
            points.push_back({scale.value(t), t * top});
        }
        return points;
    }
    // A field that has one value is as dense as it gets.
    return range[0] < range[1] ? std::vector<TransferFunction::DensityPoint>{{range[0], 0}, {range[1], top}}
                               : std::vector<TransferFunction::DensityPoint>{{range[0], top}};
}

} // namespace

double default_density(double diagonal) { return std::log(20.0) / diagonal; }

TransferFunction make_transfer_function(const SceneVolumeRendering& scene, const SceneColorMap& map,
                                        const std::array<double, 2>& range, double diagonal) {
    TransferFunction transfer;
    if (!scene.transfer_file.empty()) {
        transfer = read_transfer_file(scene.transfer_file);
    } else if (scene.transfer) {
        transfer = *scene.transfer;
    } else {
        transfer.color = colors_of(map, range);
        transfer.density = density_of(scene, map.is_logarithmic, range, diagonal);
    }
    add_peaks(scene.peaks, transfer);
    return transfer;
}

} // namespace elvis
