#include "panels.hpp"

#include <algorithm>

namespace elvis::view {

namespace {

/** The density of the highest point, with all others. */
bool edit_largest(Ui& ui, Json& rendering) {
    auto density = rendering.value("density", DensityPoints());
    double most = 0;
    for (const auto& point : density) {
        most = std::max(most, point[1]);
    }
    double wanted = most;
    if (most > 0 &&
        positive_number(
            ui, "volume/most", "Largest", wanted, most,
            "Density of the highest point, per world length: a ray keeps exp(-density * length) of the light behind")) {
        for (auto& point : density) {
            point[1] *= wanted / most;
        }
        rendering["density"] = density;
        return true;
    }
    return false;
}

bool edit_peaks(Ui& ui, Json& rendering, const std::array<double, 2>& range, double usual) {
    bool is_changed = false;
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < part_of(rendering, "peaks").size(); ++i) {
        Json& peak = rendering["peaks"][i];
        ImGui::PushID(static_cast<int>(i));
        const std::string name = "volume/peak" + std::to_string(i);
        is_changed = slider(ui, name + "/value", "Peak at", peak, "value", range[0], range[0], range[1],
                            "Value around which the layer is") ||
                     is_changed;
        const double width = peak["width"];
        if (positive_number(ui, name + "/width", "Width", peak, "width", range[1] - range[0],
                            "Full width of the layer, in values of the field")) {
            peak["width"] = is_peak(peak) ? peak["width"].get<double>() : width;
            is_changed = true;
        }
        is_changed =
            positive_number(ui, name + "/density", "Density", peak, "density", 10 * usual, "At that value, per world length") ||
            is_changed;
        is_changed =
            optional_color(ui, name + "/color", "Own colour", peak, "color", {0.9, 0.9, 0.9}, "Else that of the map") ||
            is_changed;
        ImGui::SameLine();
        if (small_button(ui, name + "/remove", "Remove", "Takes this peak away")) {
            removed = i;
        }
        ImGui::PopID();
    }
    if (removed) {
        remove_peak(rendering, *removed);
        is_changed = true;
    }
    return is_changed;
}

/** The density without peaks. */
DensityPoints base_density(Ui& ui, const Json& rendering, const Json& map, const std::array<double, 2>& range) {
    if (rendering.contains("peaks") && !rendering.contains("density") && !rendering.contains("opacity")) {
        return {};
    }
    Json plain = rendering;
    plain.erase("peaks");
    return ui.bench.transfer(map, plain, range)["density"];
}

bool edit_density(Ui& ui, Json& rendering) {
    bool is_changed = false;
    const auto own = said<std::string>(rendering, "field");
    const std::optional<std::string> field = own ? own : said<std::string>(ui.scene(), "field");
    const Json map = part_of(rendering.contains("color_map") ? rendering : ui.scene(), "color_map");
    const std::optional<FieldRange> data = ui.bench.range(field);
    if (!map.contains("range") && !data) {
        return false;
    }
    const std::array<double, 2> range = range_of(map, data);
    if (!(range[0] < range[1])) {
        ImGui::TextWrapped("The field is the same everywhere.");
        return false;
    }
    const double usual = ui.bench.transfer(Json::object(), Json::object(), {0, 1})["density"].back()[1];
    if (!rendering.contains("opacity")) {
        const DensityPoints start = {{range[0], 0}, {0.5 * (range[0] + range[1]), 0}, {range[1], usual}};
        is_changed = optional_part(ui, "volume/own density", "Own density", rendering, "density", start,
                                   "Else it grows evenly over the range of the colours");
    }
    const bool is_logarithmic = map.value("scale", "") == "logarithmic" && range[0] > 0;
    is_changed = edit_density_plot(ui, rendering, base_density(ui, rendering, map, range), range, is_logarithmic, usual,
                                   ui.bench.histogram(field)) ||
                 is_changed;
    is_changed = edit_largest(ui, rendering) || is_changed;
    if (small_button(ui, "volume/add peak", "Add a peak",
                     "A thin layer around one value, like a semi-transparent isosurface")) {
        rendering["peaks"].push_back(
            {{"value", round_middle(range)}, {"width", 0.05 * (range[1] - range[0])}, {"density", 10 * usual}});
        is_changed = true;
    }
    return edit_peaks(ui, rendering, range, usual) || is_changed;
}

bool edit_integrator(Ui& ui, Json& rendering) {
    static const std::vector<std::string> words = schema_words("/properties/volume_rendering/properties/integrator/enum");
    bool is_changed = choice(ui, "volume/integrator", "Integrator", rendering, "integrator", words,
                             "How the integral along rays is found: exact to a tolerance, or in steps");
    const std::string integrator = rendering.value("integrator", words.front());
    const bool has_tolerance = integrator == "exact" || integrator == "adaptive-trapezoid";
    if (is_changed) {
        rendering.erase(has_tolerance ? "step" : "tolerance");
    }
    if (has_tolerance) {
        return slider(ui, "volume/tolerance", "Tolerance", rendering, "tolerance", 1e-3, 1e-4, 0.1,
                      "What a colour channel may be off") ||
               is_changed;
    }
    const double diagonal = ui.model().volume()->diagonal();
    double step = rendering.value("step", diagonal / 256);
    if (positive_number(ui, "volume/step", "Step", step, diagonal / 10, "World length")) {
        rendering["step"] = step;
        is_changed = true;
    }
    return is_changed;
}

} // namespace

void remove_peak(Json& rendering, std::size_t index) {
    rendering["peaks"].erase(index);
    if (rendering["peaks"].empty()) {
        rendering.erase("peaks");
    }
}

bool edit_volume_rendering(Ui& ui, Json& rendering) {
    bool is_changed = field_choice(ui, "volume/field", "Field", rendering, "field", true, "Field or expression that is shown");
    const bool is_of_file = part_of(rendering, "transfer").is_string();
    std::string file = is_of_file ? rendering["transfer"].get<std::string>() : std::string();
    if (text(ui, "volume/file", "From file", file, "A transfer function: JSON, ElVis' own or ParaView's", "file")) {
        for (const char* const key : {"color_map", "density", "opacity", "unit_distance"}) {
            rendering.erase(key);
        }
        say(rendering, "transfer", file.empty() ? std::nullopt : std::optional(file));
        is_changed = true;
    }
    if (!rendering.contains("transfer")) {
        is_changed = optional_part(ui, "volume/own map", "Own colours", rendering, "color_map",
                                   part_of(ui.scene(), "color_map"), "Else they are those of the scene") ||
                     is_changed;
        if (rendering.contains("color_map")) {
            const auto own = said<std::string>(rendering, "field");
            is_changed = edit_color_map(ui, "volume/colors", rendering, own ? own : said<std::string>(ui.scene(), "field")) ||
                         is_changed;
        }
        is_changed = edit_density(ui, rendering) || is_changed;
    }
    return edit_integrator(ui, rendering) || is_changed;
}

} // namespace elvis::view
