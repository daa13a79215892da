#include "panels.hpp"

#include <apps/elvis/view/scene/value_scale.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace elvis::view {

namespace {

/** Position, red, green, blue. */
using MapPoints = std::vector<std::array<double, 4>>;

/** Points of a map on [0, 1], linear in between; empty if the map cannot be made: the picture says why. */
MapPoints points_of(Ui& ui, const Json& map) {
    Json plain = map;
    for (const char* const key : {"range", "scale", "below", "above", "nan"}) {
        plain.erase(key);
    }
    return ui.bench.transfer(plain, Json::object(), {0, 1})["color"];
}

bool is_logarithmic(const Json& map) { return map.value("scale", "") == "logarithmic"; }

ImU32 packed(const std::array<double, 4>& point) {
    const auto byte = [](double x) { return static_cast<int>(std::lround(255 * std::clamp(x, 0.0, 1.0))); };
    return IM_COL32(byte(point[1]), byte(point[2]), byte(point[3]), 255);
}

/** The colours, with the field's histogram above them. */
void draw_bar(Ui& ui, const std::string& name, const Json& map, const Histogram* histogram,
              const std::array<double, 2>& range) {
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = ImGui::GetFrameHeight();
    const float above = histogram != nullptr ? 2 * height : 0;
    ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::Dummy(ImVec2(width, height + above));
    explain(ui, name + "/bar",
            "The colours from the lower to the upper end of the range; above, how often the field takes each value");
    ImDrawList* list = ImGui::GetWindowDrawList();
    if (histogram != nullptr && range[1] > range[0] && (range[0] > 0 || !is_logarithmic(map))) {
        const ValueScale scale(range, is_logarithmic(map));
        const std::vector<float>& bins = histogram->bins();
        const double extent = histogram->upper() - histogram->lower();
        for (std::size_t bin = 0; bin < bins.size(); ++bin) {
            const auto place = [&](double edge) {
                const double value = histogram->lower() + extent * edge / static_cast<double>(bins.size());
                return corner.x + static_cast<float>(std::clamp(scale.position(value), 0.0, 1.0)) * width;
            };
            const float left = place(static_cast<double>(bin)), right = place(static_cast<double>(bin) + 1);
            // The square root lets rare values be seen, too.
            list->AddRectFilled(ImVec2(left, corner.y + above * (1 - std::sqrt(bins[bin]))),
                                ImVec2(std::max(right, left + 1), corner.y + above),
                                ImGui::GetColorU32(ImGuiCol_PlotHistogram));
        }
    }
    corner.y += above;
    const MapPoints points = points_of(ui, map);
    for (std::size_t i = 1; i < points.size(); ++i) {
        const ImU32 left = packed(points[i - 1]), right = packed(points[i]);
        list->AddRectFilledMultiColor(ImVec2(corner.x + static_cast<float>(points[i - 1][0]) * width, corner.y),
                                      ImVec2(corner.x + static_cast<float>(points[i][0]) * width, corner.y + height), left,
                                      right, right, left);
    }
}

bool edit_points(Ui& ui, const std::string& name, Json& map) {
    bool is_changed = choice(ui, name + "/space", "Between", map, "space", {"rgb", "lab", "hsv", "diverging", "step"},
                             "How colours between the points are found");
    auto points = map["points"].get<MapPoints>();
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < points.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const std::string point = name + "/point" + std::to_string(i);
        Rgb rgb{points[i][1], points[i][2], points[i][3]};
        double position = points[i][0];
        is_changed = color(ui, point + "/color", "##color", rgb, "Colour of this point") || is_changed;
        ImGui::SameLine();
        ImGui::SetNextItemWidth(ImGui::GetFontSize() * 6);
        if (number(ui, point + "/position", "##position", position, 1,
                   "Its place; the first and the last are the ends of the range")) {
            const double least = i > 0 ? points[i - 1][0] : -1e300;
            const double most = i + 1 < points.size() ? points[i + 1][0] : 1e300;
            position = std::clamp(position, least, most);
            is_changed = true;
        }
        points[i] = {position, rgb[0], rgb[1], rgb[2]};
        ImGui::SameLine();
        if (small_button(ui, point + "/split", "+", "Adds a point behind this one")) {
            std::array<double, 4> middle = points[i];
            for (std::size_t n = 0; n < 4; ++n) {
                middle[n] = 0.5 * (middle[n] + points[std::min(i + 1, points.size() - 1)][n]);
            }
            points.insert(points.begin() + static_cast<std::ptrdiff_t>(i) + 1, middle);
            is_changed = true;
        }
        ImGui::SameLine();
        if (points.size() > 2 && small_button(ui, point + "/remove", "-", "Removes this point")) {
            removed = i;
        }
        ImGui::PopID();
    }
    if (removed) {
        points.erase(points.begin() + static_cast<std::ptrdiff_t>(*removed));
        is_changed = true;
    }
    if (is_changed) {
        map["points"] = points;
    }
    return is_changed;
}

/** Other colours, with the ends as they are. */
void set_colors(Json& map, const char* key, const Json& colors) {
    for (const char* const other : {"name", "file", "points", "space"}) {
        map.erase(other);
    }
    map[key] = colors;
}

/** Some points of the map, linear in between, to start from. */
MapPoints few_points_of(Ui& ui, const Json& map) {
    const MapPoints all = points_of(ui, map);
    constexpr std::size_t n_points = 5;
    MapPoints few;
    for (std::size_t i = 0; i < n_points && !all.empty(); ++i) {
        const double position = static_cast<double>(i) / (n_points - 1);
        few.push_back(*std::ranges::min_element(all, {}, [=](const auto& point) { return std::abs(point[0] - position); }));
        few.back()[0] = position;
    }
    return few;
}

/** Which colours. */
bool edit_colors(Ui& ui, const std::string& name, Json& map) {
    bool is_changed = false;
    static const std::vector<std::string> names = schema_words("/$defs/color_map/properties/name/enum");
    std::vector<std::string> words = names;
    words.emplace_back("own colours");
    auto file = map.value("file", std::string());
    std::size_t chosen = names.size();
    if (!file.empty()) {
        words.push_back(std::filesystem::path(file).filename().string());
        chosen = names.size() + 1;
    } else if (!map.contains("points")) {
        chosen = static_cast<std::size_t>(std::ranges::find(names, map.value("name", names.front())) - names.begin());
    }
    if (choice(ui, name + "/map", "Colours", chosen, words, "The colour map, by name; or colours of your own")) {
        if (chosen < names.size()) {
            set_colors(map, "name", names[chosen]);
        } else if (const MapPoints few = few_points_of(ui, map); chosen == names.size() && !few.empty()) {
            set_colors(map, "points", few);
        }
        is_changed = true;
    }
    if (text(ui, name + "/file", "From file", file, "A colour map of ParaView (JSON) or of the original ElVis (XML)", "file")) {
        if (file.empty()) {
            map.erase("file");
        } else {
            set_colors(map, "file", file);
        }
        is_changed = true;
    }
    if (map.contains("points")) {
        is_changed = edit_points(ui, name, map) || is_changed;
    }
    return is_changed;
}

/** Which values are at its ends. */
bool edit_range(Ui& ui, const std::string& name, Json& map, const std::optional<std::string>& field) {
    bool is_changed = false;
    const std::optional<FieldRange> data = ui.bench.range(field);
    std::array<double, 2> range = range_of(map, data);
    bool is_log = is_logarithmic(map);
    const auto set = [&](double lower, double upper) {
        if (lower < upper && (lower > 0 || !is_log)) {
            map["range"] = {lower, upper};
            is_changed = true;
        }
    };
    if (check(ui, name + "/logarithmic", "Logarithmic", is_log,
              "Equal parts of the colours are for equal ratios of values; those not above 0 have the colour of what is not a "
              "number")) {
        is_changed = true;
        say(map, "scale", is_log ? std::optional("logarithmic") : std::nullopt);
        if (is_log && !(range[0] > 0)) {
            // The range must be above 0: some decades below its upper end.
            constexpr double decades = 1e-4;
            range[1] = range[1] > 0 ? range[1] : 1;
            range[0] = decades * range[1];
            map["range"] = range;
        }
    }
    ImGui::BeginDisabled(is_log && data && !(data->lower > 0));
    is_changed = optional_part(ui, name + "/fixed", "Fixed range", map, "range", range,
                               "Else the range is that of the field at this time step") ||
                 is_changed;
    ImGui::EndDisabled();
    if (map.contains("range")) {
        const double extent = data ? data->upper - data->lower : 1;
        double lower = range[0], upper = range[1];
        if (number(ui, name + "/lower", "Lowest", lower, extent, "Value at the lower end of the colours")) {
            set(lower, upper);
        }
        if (number(ui, name + "/upper", "Highest", upper, extent, "Value at the upper end of the colours")) {
            set(lower, upper);
        }
    }
    if (!data) {
        return is_changed;
    }
    ImGui::Text("Field: %.6g to %.6g", data->lower, data->upper);
    ImGui::BeginDisabled(is_log);
    if (button(ui, name + "/symmetric", "Symmetric", "From minus to plus the largest value of the field")) {
        const double most = std::max(std::abs(data->lower), std::abs(data->upper));
        set(-most, most);
    }
    ImGui::EndDisabled();
    ImGui::SameLine();
    const Histogram* histogram = ui.bench.histogram(field);
    ImGui::BeginDisabled(histogram == nullptr);
    if (button(ui, name + "/percentiles", "2-98 %", "Leaves out the lowest and the highest hundredths of the volume") &&
        histogram != nullptr) {
        set(histogram->quantile(0.02), histogram->quantile(0.98));
    }
    ImGui::SameLine();
    if (button(ui, name + "/percentiles10", "10-90 %", "Leaves out the lowest and the highest tenth of the volume") &&
        histogram != nullptr) {
        set(histogram->quantile(0.1), histogram->quantile(0.9));
    }
    ImGui::EndDisabled();
    return is_changed;
}

} // namespace

std::array<double, 2> range_of(const Json& map, const std::optional<FieldRange>& data) {
    return map.value("range", data ? std::array<double, 2>{data->lower, data->upper} : std::array<double, 2>{0, 1});
}

bool edit_color_map(Ui& ui, const std::string& name, Json& owner, const std::optional<std::string>& field) {
    ImGui::PushID(name.c_str());
    Json map = part_of(owner, "color_map");
    bool is_changed = edit_colors(ui, name, map);
    const std::optional<FieldRange> data = ui.bench.range(field);
    const Histogram* histogram = ui.bench.histogram(field);
    if (map.contains("range") || data) {
        draw_bar(ui, name, map, histogram, range_of(map, data));
    }
    is_changed = edit_range(ui, name, map, field) || is_changed;
    if (ImGui::TreeNode("Outside of the range")) {
        is_changed = optional_color(ui, name + "/below", "Below", map, "below", {0, 0, 0},
                                    "Colour of smaller values; else that of the lower end") ||
                     is_changed;
        is_changed = optional_color(ui, name + "/above", "Above", map, "above", {1, 1, 1},
                                    "Colour of larger values; else that of the upper end") ||
                     is_changed;
        is_changed =
            optional_color(ui, name + "/nan", "Not a number", map, "nan", {1, 0, 1}, "Colour of what is not a finite number") ||
            is_changed;
        ImGui::TreePop();
    }
    ImGui::PopID();
    if (is_changed) {
        owner["color_map"] = std::move(map);
    }
    return is_changed;
}

} // namespace elvis::view
