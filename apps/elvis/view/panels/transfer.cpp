#include "panels.hpp"

#include <core/scene/transfer.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace elvis::view {

namespace {

/** The curve of densities over the histogram; its points are dragged, added by a double click, removed by the right button. */
bool edit_curve(Ui& ui, SceneVolumeRendering& rendering, const std::array<double, 2>& range, const Histogram* histogram) {
    std::vector<TransferFunction::DensityPoint>& points = rendering.density;
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = 6 * ImGui::GetFrameHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("curve", ImVec2(width, height), ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    const bool is_hovered = ImGui::IsItemHovered(), is_active = ImGui::IsItemActive(), is_started = ImGui::IsItemActivated();
    explain(ui, "volume/curve", is_active ? "" : "Density by value, over the field's histogram. Drag a point; double click adds one, the right button removes it");
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(corner, ImVec2(corner.x + width, corner.y + height), ImGui::GetColorU32(ImGuiCol_FrameBg));
    const double extent = range[1] - range[0];
    double most = 0;
    for (const auto& point : points) {
        most = std::max(most, point.density);
    }
    // Room above the highest point, which otherwise could not be dragged upwards.
    const double top = most > 0 ? 1.25 * most : 1;
    const auto place = [&](double value, double density) {
        return ImVec2(corner.x + static_cast<float>((value - range[0]) / extent) * width,
                      corner.y + height - static_cast<float>(density / top) * height);
    };
    if (histogram != nullptr) {
        const auto& bins = histogram->bins();
        const double bin_extent = (histogram->upper() - histogram->lower()) / static_cast<double>(bins.size());
        for (std::size_t bin = 0; bin < bins.size(); ++bin) {
            const double value = histogram->lower() + bin_extent * static_cast<double>(bin);
            const ImVec2 left = place(value, 0), right = place(value + bin_extent, 0);
            list->AddRectFilled(ImVec2(left.x, corner.y + height * (1 - std::sqrt(bins[bin]))), ImVec2(right.x, corner.y + height),
                                ImGui::GetColorU32(ImGuiCol_PlotHistogram, 0.35f));
        }
    }
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    std::optional<std::size_t> near;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ImVec2 at = place(points[i].value, points[i].density);
        if (std::hypot(at.x - mouse.x, at.y - mouse.y) < 9 * ui.scale) {
            near = i;
        }
    }
    const double value = range[0] + extent * std::clamp((mouse.x - corner.x) / width, 0.0f, 1.0f);
    const double density = top * std::clamp((corner.y + height - mouse.y) / height, 0.0f, 1.0f);
    bool is_changed = false;
    ImGuiStorage* storage = ImGui::GetStateStorage();
    const ImGuiID held_id = ImGui::GetID("held");
    if (is_started) {
        storage->SetInt(held_id, near ? static_cast<int>(*near) : -1);
    }
    if (is_hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !near) {
        const auto behind = std::find_if(points.begin(), points.end(), [value](const auto& point) { return point.value > value; });
        points.insert(behind, {value, density});
        is_changed = true;
    } else if (is_hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Right) && near && points.size() > 1) {
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(*near));
        storage->SetInt(held_id, -1);
        is_changed = true;
    } else if (is_active && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 2)) {
        const int held = storage->GetInt(held_id, -1);
        if (held >= 0 && static_cast<std::size_t>(held) < points.size()) {
            const auto i = static_cast<std::size_t>(held);
            const double least = i > 0 ? points[i - 1].value : -1e300;
            const double largest = i + 1 < points.size() ? points[i + 1].value : 1e300;
            const TransferFunction::DensityPoint moved{std::clamp(value, least, largest), density};
            is_changed = moved.value != points[i].value || moved.density != points[i].density;
            points[i] = moved;
        }
    }
    const ImU32 line = ImGui::GetColorU32(ImGuiCol_PlotLines);
    ImVec2 before = points.empty() ? corner : ImVec2(corner.x, place(0, points.front().density).y);
    for (const auto& point : points) {
        const ImVec2 at = place(point.value, point.density);
        list->AddLine(before, at, line, 2 * ui.scale);
        before = at;
    }
    list->AddLine(before, ImVec2(corner.x + width, before.y), line, 2 * ui.scale);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const ImVec2 at = place(points[i].value, points[i].density);
        list->AddCircleFilled(at, 5 * ui.scale, near == i ? IM_COL32(255, 255, 255, 255) : IM_COL32(255, 200, 40, 255));
        ui.places["volume/curve/point" + std::to_string(i)] = {at.x - 4, at.y - 4, at.x + 4, at.y + 4};
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
    const std::array<double, 2> range = map.range.value_or(data ? std::array<double, 2>{data->lower, data->upper} : std::array<double, 2>{0, 1});
    if (!(range[0] < range[1])) {
        ImGui::TextWrapped("The field is the same everywhere.");
        return false;
    }
    const double usual = default_density(ui.model().volume()->diagonal());
    bool is_own = !rendering.density.empty();
    if (rendering.opacity.empty() && check(ui, "volume/own density", "Own density", is_own, "Else it grows evenly over the range of the colours")) {
        rendering.density.clear();
        if (is_own) {
            rendering.density = {{range[0], 0}, {0.5 * (range[0] + range[1]), 0}, {range[1], usual}};
        }
        is_changed = true;
    }
    if (!rendering.density.empty()) {
        is_changed = edit_curve(ui, rendering, range, ui.bench.histogram(field)) || is_changed;
        double most = 0;
        for (const auto& point : rendering.density) {
            most = std::max(most, point.density);
        }
        double wanted = most;
        if (most > 0 && positive_number(ui, "volume/most", "Largest", wanted, most, "Density of the highest point, per world length: a ray keeps exp(-density * length) of the light behind")) {
            for (auto& point : rendering.density) {
                point.density *= wanted / most;
            }
            is_changed = true;
        }
    }
    if (small_button(ui, "volume/add peak", "Add a peak", "A thin layer around one value, like a semi-transparent isosurface")) {
        rendering.peaks.push_back({0.5 * (range[0] + range[1]), 0.05 * (range[1] - range[0]), 10 * usual, std::nullopt});
        is_changed = true;
    }
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < rendering.peaks.size(); ++i) {
        ScenePeak& peak = rendering.peaks[i];
        ImGui::PushID(static_cast<int>(i));
        const std::string name = "volume/peak" + std::to_string(i);
        is_changed = slider(ui, name + "/value", "Peak at", peak.value, range[0], range[1], "Value around which the layer is") || is_changed;
        const double width = peak.width;
        if (positive_number(ui, name + "/width", "Width", peak.width, range[1] - range[0], "Full width of the layer, in values of the field")) {
            // As the reader asks for: not lost in rounding.
            if (!(peak.value - 0.5 * peak.width < peak.value && peak.value < peak.value + 0.5 * peak.width)) {
                peak.width = width;
            }
            is_changed = true;
        }
        is_changed = positive_number(ui, name + "/density", "Density", peak.density, 10 * usual, "At that value, per world length") || is_changed;
        is_changed = optional_color(ui, name + "/color", "Own colour", peak.color, {0.9, 0.9, 0.9}, "Else that of the map") || is_changed;
        ImGui::SameLine();
        if (small_button(ui, name + "/remove", "Remove", "Takes this peak away")) {
            removed = i;
        }
        ImGui::PopID();
    }
    if (removed) {
        rendering.peaks.erase(rendering.peaks.begin() + static_cast<std::ptrdiff_t>(*removed));
        is_changed = true;
    }
    return is_changed;
}

bool edit_integrator(Ui& ui, SceneVolumeRendering& rendering) {
    std::vector<std::string> words;
    std::size_t chosen = 0;
    for (const auto& [name, integrator] : integrator_names()) {
        chosen = integrator == rendering.integrator ? words.size() : chosen;
        words.push_back(name);
    }
    bool is_changed = false;
    if (choice(ui, "volume/integrator", "Integrator", chosen, words, "How the integral along rays is found: exact to a tolerance, or in steps")) {
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
        is_changed = slider(ui, "volume/tolerance", "Tolerance", rendering.tolerance, 1e-4, 0.1, "What a colour channel may be off") || is_changed;
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
            is_changed = edit_color_map(ui, "volume/colors", *rendering.color_map, rendering.field ? rendering.field : ui.scene().field) || is_changed;
        }
        is_changed = edit_density(ui, rendering) || is_changed;
    }
    return edit_integrator(ui, rendering) || is_changed;
}

} // namespace elvis::view
