#include "panels.hpp"

#include <apps/elvis/view/scene/value_scale.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::view {

namespace {

constexpr float point_radius = 5;
/** How near the cursor must be to take a point. */
constexpr float reach = 9;

/** What can be taken by the hand: a point of the density, the top of a peak, or the middle of its right side. */
struct Grip {
    enum class Kind { point, top, side };
    Kind kind;
    std::size_t index;

    bool operator==(const Grip&) const = default;
};

/** Values from left to right as the colours have them, densities upwards. */
struct Plot {
    ImVec2 corner;
    float width, height;
    ValueScale scale;
    double top;

    ImVec2 place(double value, double density) const {
        return ImVec2(corner.x + static_cast<float>(std::clamp(scale.position(value), -1.0, 2.0)) * width,
                      corner.y + height - static_cast<float>(density / top) * height);
    }
    double value(const ImVec2& at) const { return scale.value(std::clamp((at.x - corner.x) / width, 0.0f, 1.0f)); }
    double density(const ImVec2& at) const { return top * std::clamp((corner.y + height - at.y) / height, 0.0f, 1.0f); }
};

struct Peak {
    double value, width, density;
};

Peak peak_of(const Json& peak) { return {peak["value"], peak["width"], peak["density"]}; }

DensityPoints own_density(const Json& rendering) { return rendering.value("density", DensityPoints()); }

/** With their places on the screen. */
using Grips = std::vector<std::pair<Grip, ImVec2>>;

Grips grips_of(const Json& rendering, const Plot& plot) {
    Grips grips;
    const DensityPoints density = own_density(rendering);
    for (std::size_t i = 0; i < density.size(); ++i) {
        grips.push_back({{Grip::Kind::point, i}, plot.place(density[i][0], density[i][1])});
    }
    for (std::size_t i = 0; i < part_of(rendering, "peaks").size(); ++i) {
        const Peak peak = peak_of(rendering["peaks"][i]);
        grips.push_back({{Grip::Kind::top, i}, plot.place(peak.value, peak.density)});
        grips.push_back({{Grip::Kind::side, i}, plot.place(peak.value + 0.25 * peak.width, 0.5 * peak.density)});
    }
    return grips;
}

void draw_histogram(ImDrawList* list, const Plot& plot, const Histogram& histogram) {
    const auto& bins = histogram.bins();
    const double extent = (histogram.upper() - histogram.lower()) / static_cast<double>(bins.size());
    for (std::size_t bin = 0; bin < bins.size(); ++bin) {
        const double value = histogram.lower() + extent * static_cast<double>(bin);
        const float left = plot.place(value, 0).x, right = plot.place(value + extent, 0).x;
        // The square root lets rare values be seen, too.
        list->AddRectFilled(ImVec2(left, plot.corner.y + plot.height * (1 - std::sqrt(bins[bin]))),
                            ImVec2(right, plot.corner.y + plot.height), ImGui::GetColorU32(ImGuiCol_PlotHistogram, 0.35f));
    }
}

void draw_peaks(ImDrawList* list, const Plot& plot, const Json& peaks, float line) {
    for (const Json& said_of_it : peaks) {
        const Peak peak = peak_of(said_of_it);
        const Rgb rgb = said_of_it.value("color", Rgb{0.7, 0.7, 0.7});
        const auto byte = [](double x) { return static_cast<int>(std::lround(255 * std::clamp(x, 0.0, 1.0))); };
        const ImVec2 left = plot.place(peak.value - 0.5 * peak.width, 0), right = plot.place(peak.value + 0.5 * peak.width, 0),
                     top = plot.place(peak.value, peak.density);
        list->AddTriangleFilled(left, top, right, IM_COL32(byte(rgb[0]), byte(rgb[1]), byte(rgb[2]), 110));
        list->AddTriangle(left, top, right, IM_COL32(byte(rgb[0]), byte(rgb[1]), byte(rgb[2]), 255), line);
    }
}

void draw_density(ImDrawList* list, const Plot& plot, const DensityPoints& points, float line) {
    if (points.empty()) {
        return;
    }
    const ImU32 color = ImGui::GetColorU32(ImGuiCol_PlotLines);
    ImVec2 before(plot.corner.x, plot.place(points.front()[0], points.front()[1]).y);
    for (const auto& [value, density] : points) {
        const ImVec2 at = plot.place(value, density);
        list->AddLine(before, at, color, line);
        before = at;
    }
    list->AddLine(before, ImVec2(plot.corner.x + plot.width, before.y), color, line);
}

bool drag_point(Json& rendering, std::size_t index, double value, double density) {
    DensityPoints points = own_density(rendering);
    if (index >= points.size()) {
        return false;
    }
    const double least = index > 0 ? points[index - 1][0] : -1e300;
    const double largest = index + 1 < points.size() ? points[index + 1][0] : 1e300;
    const std::array<double, 2> moved{std::clamp(value, least, largest), density};
    const bool is_changed = moved != points[index];
    points[index] = moved;
    rendering["density"] = points;
    return is_changed;
}

/** The hand has the grip, and is at the cursor. Returns whether something changed. */
bool drag(Json& rendering, const Grip& grip, const Plot& plot, const ImVec2& mouse) {
    const double value = plot.value(mouse), density = plot.density(mouse);
    if (grip.kind == Grip::Kind::point) {
        return drag_point(rendering, grip.index, value, density);
    }
    if (grip.index >= part_of(rendering, "peaks").size()) {
        return false;
    }
    Json& before = rendering["peaks"][grip.index];
    Json peak = before;
    if (grip.kind == Grip::Kind::top) {
        peak["value"] = value;
        peak["density"] = std::max(density, 1e-3 * plot.top);
    } else {
        peak["width"] = 4 * std::max(value - peak["value"].get<double>(), 0.0);
    }
    if (peak == before || !is_peak(peak)) {
        return false;
    }
    before = std::move(peak);
    return true;
}

/** The density at the highest point. */
double largest_density(const DensityPoints& base, const Json& peaks) {
    double most = 0;
    for (const auto& point : base) {
        most = std::max(most, point[1]);
    }
    for (const Json& peak : peaks) {
        most = std::max(most, peak_of(peak).density);
    }
    return most;
}

/** What is within reach of the cursor. */
std::optional<std::size_t> nearest_grip(const Grips& grips, const ImVec2& mouse, float scale) {
    std::optional<std::size_t> near;
    float nearest = reach * scale;
    for (std::size_t i = 0; i < grips.size(); ++i) {
        const float distance = std::hypot(grips[i].second.x - mouse.x, grips[i].second.y - mouse.y);
        if (distance < nearest) {
            nearest = distance;
            near = i;
        }
    }
    return near;
}

void insert_point(Json& rendering, const std::array<double, 2>& point) {
    DensityPoints density = own_density(rendering);
    density.insert(std::ranges::find_if(density, [&](const auto& other) { return other[0] > point[0]; }), point);
    rendering["density"] = density;
}

/** Takes a peak away, or a point but for the last. */
bool remove_grip(Json& rendering, const Grip& grip) {
    if (grip.kind != Grip::Kind::point) {
        remove_peak(rendering, grip.index);
        return true;
    }
    if (rendering["density"].size() > 1) {
        rendering["density"].erase(grip.index);
        return true;
    }
    return false;
}

void draw_grips(Ui& ui, ImDrawList* list, const Grips& grips, std::optional<std::size_t> lit) {
    for (std::size_t i = 0; i < grips.size(); ++i) {
        const auto& [grip, at] = grips[i];
        const float radius = (grip.kind == Grip::Kind::side ? 0.7f : 1.0f) * point_radius * ui.scale;
        list->AddCircleFilled(at, radius, lit == i ? IM_COL32(255, 255, 255, 255) : IM_COL32(255, 200, 40, 255));
        static constexpr const char* names[] = {"point", "peak", "side"};
        ui.places[std::string("volume/curve/") + names[static_cast<std::size_t>(grip.kind)] + std::to_string(grip.index)] = {
            at.x - 4, at.y - 4, at.x + 4, at.y + 4};
    }
}

} // namespace

bool is_peak(const Json& said_of_it) {
    const Peak peak = peak_of(said_of_it);
    return peak.density > 0 && peak.value - 0.5 * peak.width < peak.value && peak.value < peak.value + 0.5 * peak.width;
}

bool edit_density_plot(Ui& ui, Json& rendering, const DensityPoints& base, const std::array<double, 2>& range,
                       bool is_logarithmic, double usual, const Histogram* histogram) {
    const double most = largest_density(base, part_of(rendering, "peaks"));
    Plot plot{ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail().x, 6 * ImGui::GetFrameHeight(),
              ValueScale(range, is_logarithmic),
              // Room above the highest point, which otherwise could not be dragged upwards.
              most > 0 ? 1.25 * most : usual};
    ImGui::InvisibleButton("curve", ImVec2(plot.width, plot.height),
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    const bool is_hovered = ImGui::IsItemHovered(), is_active = ImGui::IsItemActive(), is_started = ImGui::IsItemActivated();
    explain(ui, "volume/curve",
            is_active ? ""
                      : "Density by value, over the field's histogram. Drag points, and tops and sides of peaks. With a "
                        "density of its own, a double click adds a point; the right button removes a point or a peak");
    ImGuiStorage* storage = ImGui::GetStateStorage();
    const ImGuiID held_id = ImGui::GetID("held"), top_id = ImGui::GetID("top");
    if (is_started) {
        storage->SetFloat(top_id, static_cast<float>(plot.top));
        storage->SetInt(held_id, -1);
    } else if (is_active) {
        plot.top =
            static_cast<double>(storage->GetFloat(top_id, static_cast<float>(plot.top))); // It stays while the hand is at work.
    }
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const Grips grips = grips_of(rendering, plot);
    const std::optional<std::size_t> near = nearest_grip(grips, mouse, ui.scale);
    if (is_started && near) {
        storage->SetInt(held_id, static_cast<int>(*near));
    }
    bool is_changed = false;
    if (is_hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) && !near && rendering.contains("density")) {
        insert_point(rendering, {plot.value(mouse), plot.density(mouse)});
        storage->SetInt(held_id, -1);
        is_changed = true;
    } else if (is_hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Right) && near) {
        storage->SetInt(held_id, -1);
        is_changed = remove_grip(rendering, grips[*near].first);
    } else if (is_active && ImGui::IsMouseDragging(ImGuiMouseButton_Left, 2)) {
        const int held = storage->GetInt(held_id, -1);
        if (held >= 0 && static_cast<std::size_t>(held) < grips.size()) {
            is_changed = drag(rendering, grips[static_cast<std::size_t>(held)].first, plot, mouse);
        }
    }
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImVec2 end(plot.corner.x + plot.width, plot.corner.y + plot.height);
    list->AddRectFilled(plot.corner, end, ImGui::GetColorU32(ImGuiCol_FrameBg));
    list->PushClipRect(plot.corner, end, true);
    if (histogram != nullptr) {
        draw_histogram(list, plot, *histogram);
    }
    draw_peaks(list, plot, part_of(rendering, "peaks"), 1.5f * ui.scale);
    draw_density(list, plot, base, 2 * ui.scale);
    draw_grips(ui, list, grips, is_hovered ? near : std::nullopt);
    list->PopClipRect();
    return is_changed;
}

} // namespace elvis::view
