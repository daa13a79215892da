#include "panels.hpp"

#include <core/scene/color/transfer.hpp>

#include <algorithm>

namespace elvis::view {

namespace {

/** The density of the highest point, with all others. */
bool edit_largest(Ui& ui, std::vector<TransferFunction::DensityPoint>& density) {
    double most = 0;
    for (const auto& point : density) {
        most = std::max(most, point.density);
    }
    double wanted = most;
    if (most > 0 &&
        positive_number(
            ui, "volume/most", "Largest", wanted, most,
            "Density of the highest point, per world length: a ray keeps exp(-density * length) of the light behind")) {
        for (auto& point : density) {
            point.density *= wanted / most;
        }
        return true;
    }
    return false;
}

bool edit_peaks(Ui& ui, std::vector<ScenePeak>& peaks, const std::array<double, 2>& range, double usual) {
    bool is_changed = false;
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < peaks.size(); ++i) {
        ScenePeak& peak = peaks[i];
        ImGui::PushID(static_cast<int>(i));
        const std::string name = "volume/peak" + std::to_string(i);
        is_changed =
            slider(ui, name + "/value", "Peak at", peak.value, range[0], range[1], "Value around which the layer is") ||
            is_changed;
        const double width = peak.width;
        if (positive_number(ui, name + "/width", "Width", peak.width, range[1] - range[0],
                            "Full width of the layer, in values of the field")) {
            peak.width = is_peak(peak) ? peak.width : width;
            is_changed = true;
        }
        is_changed =
            positive_number(ui, name + "/density", "Density", peak.density, 10 * usual, "At that value, per world length") ||
            is_changed;
        is_changed = optional_color(ui, name + "/color", "Own colour", peak.color, {0.9, 0.9, 0.9}, "Else that of the map") ||
                     is_changed;
        ImGui::SameLine();
        if (small_button(ui, name + "/remove", "Remove", "Takes this peak away")) {
            removed = i;
        }
        ImGui::PopID();
    }
    if (removed) {
        peaks.erase(peaks.begin() + static_cast<std::ptrdiff_t>(*removed));
        is_changed = true;
    }
    return is_changed;
}

bool edit_density(Ui& ui, SceneVolumeRendering& rendering) {
    bool is_changed = false;
    const std::optional<std::string>& field = rendering.field ? rendering.field : ui.scene().field;
    const SceneColorMap& map = rendering.color_map ? *rendering.color_map : ui.scene().color_map;
    const std::optional<FieldRange> data = ui.bench.range(field);
    if (!map.range && !data) {
        return false;
    }
    const std::array<double, 2> range =
        map.range.value_or(data ? std::array<double, 2>{data->lower, data->upper} : std::array<double, 2>{0, 1});
    if (!(range[0] < range[1])) {
        ImGui::TextWrapped("The field is the same everywhere.");
        return false;
    }
    const double usual = default_density(ui.model().volume()->diagonal());
    bool is_own = !rendering.density.empty();
    if (rendering.opacity.empty() &&
        check(ui, "volume/own density", "Own density", is_own, "Else it grows evenly over the range of the colours")) {
        rendering.density.clear();
        if (is_own) {
            rendering.density = {{range[0], 0}, {0.5 * (range[0] + range[1]), 0}, {range[1], usual}};
        }
        is_changed = true;
    }
    const bool is_logarithmic = map.is_logarithmic && range[0] > 0;
    is_changed = edit_density_plot(ui, rendering, range, is_logarithmic, usual, ui.bench.histogram(field)) || is_changed;
    is_changed = edit_largest(ui, rendering.density) || is_changed;
    if (small_button(ui, "volume/add peak", "Add a peak",
                     "A thin layer around one value, like a semi-transparent isosurface")) {
        rendering.peaks.push_back({round_middle(range), 0.05 * (range[1] - range[0]), 10 * usual, std::nullopt});
        is_changed = true;
    }
    return edit_peaks(ui, rendering.peaks, range, usual) || is_changed;
}

bool edit_integrator(Ui& ui, SceneVolumeRendering& rendering) {
    std::vector<std::string> words;
    std::size_t chosen = 0;
    for (const auto& [name, integrator] : integrator_names()) {
        chosen = integrator == rendering.integrator ? words.size() : chosen;
        words.push_back(name);
    }
    bool is_changed = false;
    if (choice(ui, "volume/integrator", "Integrator", chosen, words,
               "How the integral along rays is found: exact to a tolerance, or in steps")) {
        rendering.integrator = integrator_names()[chosen].second;
        is_changed = true;
    }
    if (has_steps(rendering.integrator)) {
        double step = rendering.step.value_or(ui.model().volume()->diagonal() / 256);
        if (positive_number(ui, "volume/step", "Step", step, ui.model().volume()->diagonal() / 10, "World length")) {
            rendering.step = step;
            is_changed = true;
        }
    } else {
        is_changed =
            slider(ui, "volume/tolerance", "Tolerance", rendering.tolerance, 1e-4, 0.1, "What a colour channel may be off") ||
            is_changed;
    }
    return is_changed;
}

} // namespace

bool edit_volume_rendering(Ui& ui, SceneVolumeRendering& rendering) {
    bool is_changed = field_choice(ui, "volume/field", "Field", rendering.field, true, "Field or expression that is shown");
    std::string file = rendering.transfer_file;
    if (text(ui, "volume/file", "From file", file, "A transfer function: JSON, ElVis' own or ParaView's", "file")) {
        const SceneVolumeRendering before = rendering;
        rendering = SceneVolumeRendering{};
        rendering.field = before.field;
        rendering.peaks = before.peaks;
        rendering.transfer_file = file;
        is_changed = true;
    }
    if (rendering.is_colored_by_map()) {
        bool has_map = rendering.color_map.has_value();
        if (check(ui, "volume/own map", "Own colours", has_map, "Else they are those of the scene")) {
            rendering.color_map = has_map ? std::optional(ui.scene().color_map) : std::nullopt;
            is_changed = true;
        }
        if (rendering.color_map) {
            is_changed = edit_color_map(ui, "volume/colors", *rendering.color_map,
                                        rendering.field ? rendering.field : ui.scene().field) ||
                         is_changed;
        }
        is_changed = edit_density(ui, rendering) || is_changed;
    }
    return edit_integrator(ui, rendering) || is_changed;
}

} // namespace elvis::view
