#include "panels.hpp"

#include <core/scene/color/color_map.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace elvis::view {

namespace {

/** Points of a map on [0, 1], linear in between; empty if the map cannot be made. */
std::vector<SceneColorMap::Point> points_of(const SceneColorMap& map) {
    std::vector<SceneColorMap::Point> points;
    try {
        SceneColorMap plain = map;
        plain.range.reset();
        plain.is_logarithmic = false;
        for (const ColorTable::Point& point : make_color_table(plain, {0, 1}).points) {
            points.push_back({point.value, point.rgb});
        }
    } catch (const std::exception&) {
        points.clear(); // The picture says why.
    }
    return points;
}

ImU32 packed(const Rgb& rgb) {
    const auto byte = [](double x) { return static_cast<int>(std::lround(255 * std::clamp(x, 0.0, 1.0))); };
    return IM_COL32(byte(rgb[0]), byte(rgb[1]), byte(rgb[2]), 255);
}

/** The colours, with the field's histogram above them. */
void draw_bar(Ui& ui, const std::string& name, const SceneColorMap& map, const Histogram* histogram,
              const std::array<double, 2>& range) {
    const float width = ImGui::GetContentRegionAvail().x;
    const float height = ImGui::GetFrameHeight();
    const float above = histogram != nullptr ? 2 * height : 0;
    ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::Dummy(ImVec2(width, height + above));
    explain(ui, name + "/bar",
            "The colours from the lower to the upper end of the range; above, how often the field takes each value");
    ImDrawList* list = ImGui::GetWindowDrawList();
    if (histogram != nullptr && range[1] > range[0] && (range[0] > 0 || !map.is_logarithmic)) {
        const ColorScale scale(range, map.is_logarithmic);
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
    const std::vector<SceneColorMap::Point> points = points_of(map);
    for (std::size_t i = 1; i < points.size(); ++i) {
        const ImU32 left = packed(points[i - 1].rgb), right = packed(points[i].rgb);
        list->AddRectFilledMultiColor(ImVec2(corner.x + static_cast<float>(points[i - 1].position) * width, corner.y),
                                      ImVec2(corner.x + static_cast<float>(points[i].position) * width, corner.y + height),
                                      left, right, right, left);
    }
}

bool edit_points(Ui& ui, const std::string& name, SceneColorMap& map) {
    bool is_changed = false;
    static const std::vector<std::string> spaces = {"rgb", "lab", "hsv", "diverging", "step"};
    auto space = static_cast<std::size_t>(map.space);
    if (choice(ui, name + "/space", "Between", space, spaces, "How colours between the points are found")) {
        map.space = static_cast<ColorSpace>(space);
        is_changed = true;
    }
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        const std::string point = name + "/point" + std::to_string(i);
        is_changed = color(ui, point + "/color", "##color", map.points[i].rgb, "Colour of this point") || is_changed;
        ImGui::SameLine();
        ImGui::SetNextItemWidth(ImGui::GetFontSize() * 6);
        double position = map.points[i].position;
        if (number(ui, point + "/position", "##position", position, 1,
                   "Its place; the first and the last are the ends of the range")) {
            const double least = i > 0 ? map.points[i - 1].position : -1e300;
            const double most = i + 1 < map.points.size() ? map.points[i + 1].position : 1e300;
            map.points[i].position = std::clamp(position, least, most);
            is_changed = true;
        }
        ImGui::SameLine();
        if (small_button(ui, point + "/split", "+", "Adds a point behind this one")) {
            const SceneColorMap::Point from = map.points[i];
            const SceneColorMap::Point to = map.points[std::min(i + 1, map.points.size() - 1)];
            SceneColorMap::Point middle{0.5 * (from.position + to.position), {}};
            for (std::size_t channel = 0; channel < 3; ++channel) {
                middle.rgb[channel] = 0.5 * (from.rgb[channel] + to.rgb[channel]);
            }
            map.points.insert(map.points.begin() + static_cast<std::ptrdiff_t>(i) + 1, middle);
            is_changed = true;
        }
        ImGui::SameLine();
        if (map.points.size() > 2 && small_button(ui, point + "/remove", "-", "Removes this point")) {
            removed = i;
        }
        ImGui::PopID();
    }
    if (removed) {
        map.points.erase(map.points.begin() + static_cast<std::ptrdiff_t>(*removed));
        is_changed = true;
    }
    return is_changed;
}

/** Which colours. */
bool edit_colors(Ui& ui, const std::string& name, SceneColorMap& map) {
    bool is_changed = false;
    std::vector<std::string> words = color_map_names();
    const std::size_t n_names = words.size();
    words.emplace_back("own colours");
    if (!map.file.empty()) {
        words.push_back(std::filesystem::path(map.file).filename().string());
    }
    std::size_t chosen = n_names;
    if (!map.file.empty()) {
        chosen = n_names + 1;
    } else if (map.points.empty()) {
        const std::string shown = map.name.empty() ? "viridis" : map.name; // As make_color_table has it.
        chosen = static_cast<std::size_t>(std::find(words.begin(), words.end(), shown) - words.begin());
    }
    if (choice(ui, name + "/map", "Colours", chosen, words, "The colour map, by name; or colours of your own")) {
        if (chosen < n_names) {
            map.name = words[chosen];
            map.file.clear();
            map.points.clear();
            map.space = ColorSpace::rgb;
        } else if (chosen == n_names) {
            // As they are now, to start from: some points of the map, linear in between.
            const std::vector<SceneColorMap::Point> all = points_of(map);
            constexpr std::size_t n_points = 5;
            map.points.clear();
            for (std::size_t i = 0; i < n_points && !all.empty(); ++i) {
                const double position = static_cast<double>(i) / (n_points - 1);
                const auto nearest = std::min_element(all.begin(), all.end(), [position](const auto& a, const auto& b) {
                    return std::abs(a.position - position) < std::abs(b.position - position);
                });
                map.points.push_back({position, nearest->rgb});
            }
            map.name.clear();
            map.file.clear();
            map.space = ColorSpace::rgb;
        }
        is_changed = true;
    }
    std::string file = map.file;
    if (text(ui, name + "/file", "From file", file, "A colour map of ParaView (JSON) or of the original ElVis (XML)", "file")) {
        map.file = file;
        if (!file.empty()) {
            map.name.clear();
            map.points.clear();
        }
        is_changed = true;
    }
    if (!map.points.empty()) {
        is_changed = edit_points(ui, name, map) || is_changed;
    }
    return is_changed;
}

/** Which values are at its ends. */
bool edit_range(Ui& ui, const std::string& name, SceneColorMap& map, const std::optional<std::string>& field) {
    bool is_changed = false;
    const std::optional<FieldRange> data = ui.bench.range(field);
    std::array<double, 2> range =
        map.range.value_or(data ? std::array<double, 2>{data->lower, data->upper} : std::array<double, 2>{0, 1});
    const auto set = [&](double lower, double upper) {
        if (lower < upper && (lower > 0 || !map.is_logarithmic)) {
            map.range = {lower, upper};
            is_changed = true;
        }
    };
    if (check(ui, name + "/logarithmic", "Logarithmic", map.is_logarithmic,
              "Equal parts of the colours are for equal ratios of values; those not above 0 have the colour of what is not a "
              "number")) {
        is_changed = true;
        if (map.is_logarithmic && !(range[0] > 0)) {
            // The range must be above 0: some decades below its upper end.
            constexpr double decades = 1e-4;
            range[1] = range[1] > 0 ? range[1] : 1;
            range[0] = decades * range[1];
            map.range = range;
        }
    }
    bool is_fixed = map.range.has_value();
    ImGui::BeginDisabled(map.is_logarithmic && data && !(data->lower > 0));
    if (check(ui, name + "/fixed", "Fixed range", is_fixed, "Else the range is that of the field at this time step")) {
        map.range = is_fixed ? std::optional(range) : std::nullopt;
        is_changed = true;
    }
    ImGui::EndDisabled();
    if (map.range) {
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
    ImGui::BeginDisabled(map.is_logarithmic);
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

bool edit_color_map(Ui& ui, const std::string& name, SceneColorMap& map, const std::optional<std::string>& field) {
    ImGui::PushID(name.c_str());
    bool is_changed = edit_colors(ui, name, map);
    const std::optional<FieldRange> data = ui.bench.range(field);
    const Histogram* histogram = ui.bench.histogram(field);
    if (map.range || data) {
        draw_bar(ui, name, map, histogram,
                 map.range.value_or(data ? std::array<double, 2>{data->lower, data->upper} : std::array<double, 2>{0, 1}));
    }
    is_changed = edit_range(ui, name, map, field) || is_changed;
    if (ImGui::TreeNode("Outside of the range")) {
        is_changed = optional_color(ui, name + "/below", "Below", map.below, {0, 0, 0},
                                    "Colour of smaller values; else that of the lower end") ||
                     is_changed;
        is_changed = optional_color(ui, name + "/above", "Above", map.above, {1, 1, 1},
                                    "Colour of larger values; else that of the upper end") ||
                     is_changed;
        is_changed =
            optional_color(ui, name + "/nan", "Not a number", map.nan, {1, 0, 1}, "Colour of what is not a finite number") ||
            is_changed;
        ImGui::TreePop();
    }
    ImGui::PopID();
    return is_changed;
}

namespace {

bool edit_line_style(Ui& ui, const std::string& name, SceneLineStyle& style) {
    bool is_changed = slider(ui, name + "/width", "Width", style.width, 1, 16, "In pixels");
    is_changed = optional_color(ui, name + "/color", "Own colour", style.color, {0, 0, 0},
                                "Else black or white, whichever stands out; of mesh lines black") ||
                 is_changed;
    is_changed = optional_color(ui, name + "/undecided", "Mark undecided", style.undecided_color, {1, 0, 1},
                                "Colour of pixels for which it stays open whether they meet a line") ||
                 is_changed;
    return is_changed;
}

} // namespace

bool edit_contours(Ui& ui, const std::string& name, std::optional<SceneContours>& contours) {
    ImGui::PushID(name.c_str());
    bool has = contours.has_value();
    bool is_changed = check(ui, name, "Contours", has, "Lines on which the field takes given values");
    if (is_changed) {
        contours = has ? std::optional(SceneContours{}) : std::nullopt;
        if (contours) {
            contours->is_round = true;
        }
    }
    if (contours) {
        ImGui::Indent();
        if (check(ui, name + "/round", "Round values", contours->is_round,
                  "Some ten round values in the range of the colours")) {
            contours->count = contours->is_round ? 0 : 9;
            contours->values.clear();
            is_changed = true;
        }
        int count = static_cast<int>(contours->count);
        if (!contours->is_round &&
            ImGui::SliderInt("Number", &count, 0, 50, count == 0 ? "given values" : "%d", ImGuiSliderFlags_AlwaysClamp)) {
            contours->count = static_cast<std::uint32_t>(count);
            is_changed = true;
            if (count > 0) {
                contours->values.clear();
            } else {
                contours->range.reset();
            }
        }
        if (!contours->is_round) {
            explain(ui, name + "/count", "So many that divide the range of the colours evenly; 0 for values of your own");
        }
        if (!contours->is_round && contours->count == 0) {
            is_changed =
                number_list(ui, name + "/values", "Values", contours->values, "Values of the lines, separated by blanks") ||
                is_changed;
        }
        is_changed = edit_line_style(ui, name, contours->style) || is_changed;
        ImGui::Unindent();
    }
    ImGui::PopID();
    return is_changed;
}

bool edit_mesh_lines(Ui& ui, const std::string& name, std::optional<SceneLineStyle>& lines) {
    ImGui::PushID(name.c_str());
    bool has = lines.has_value();
    bool is_changed = check(ui, name, "Mesh lines", has, "Where the boundaries of elements meet the surface");
    if (is_changed) {
        lines = has ? std::optional(SceneLineStyle{}) : std::nullopt;
    }
    if (lines) {
        ImGui::Indent();
        is_changed = edit_line_style(ui, name, *lines) || is_changed;
        ImGui::Unindent();
    }
    ImGui::PopID();
    return is_changed;
}

} // namespace elvis::view
