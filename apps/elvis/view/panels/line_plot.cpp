#include "line_plot.hpp"

#include <core/base/plot_ticks.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace elvis::view {

namespace {

/** Told apart on dark and on light ground. */
constexpr std::array<ImU32, 6> curve_colors = {IM_COL32(64, 140, 230, 255),  IM_COL32(230, 120, 30, 255),
                                               IM_COL32(60, 170, 90, 255),   IM_COL32(200, 70, 160, 255),
                                               IM_COL32(150, 110, 230, 255), IM_COL32(150, 150, 40, 255)};

/** What the plot shows and where: data to the screen. */
struct PlotFrame {
    double first = 0, last = 1, lower = 0, upper = 1;
    ImVec2 corner, end;

    ImVec2 place(double x, double y) const {
        const auto across = static_cast<float>((x - first) / (last - first)),
                   up = static_cast<float>((y - lower) / (upper - lower));
        return ImVec2(corner.x + across * (end.x - corner.x), end.y - up * (end.y - corner.y));
    }
    double arc_length(float x) const { return first + (last - first) * double{(x - corner.x) / (end.x - corner.x)}; }
};

std::string short_number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

/** The curves' range, with a little room; something about the value where there is but one. */
void fit_values(PlotFrame& frame, const LineAnswer& answer) {
    double lower = HUGE_VAL, upper = -HUGE_VAL;
    for (const commands::SampledCurve& curve : answer.curves) {
        for (const auto& point : curve.points) {
            if (std::isfinite(point[1])) {
                lower = std::min(lower, point[1]);
                upper = std::max(upper, point[1]);
            }
        }
    }
    if (!(lower <= upper)) {
        return;
    }
    const double size = std::max(std::abs(lower), std::abs(upper));
    const double room = upper - lower > 1e-12 * size ? 0.05 * (upper - lower) : size > 0 ? 0.1 * size : 1;
    frame.lower = lower - room;
    frame.upper = upper + room;
}

void draw_axes(const PlotFrame& frame) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    const ImU32 text = ImGui::GetColorU32(ImGuiCol_Text), grid = ImGui::GetColorU32(ImGuiCol_Text, 0.15f);
    const float height = ImGui::GetTextLineHeight();
    for (const double value : plot_ticks(frame.lower, frame.upper, false)) {
        const ImVec2 at = frame.place(frame.first, value);
        const std::string label = short_number(value);
        list->AddLine(at, ImVec2(frame.end.x, at.y), grid);
        list->AddText(ImVec2(at.x - ImGui::CalcTextSize(label.c_str()).x - 0.3f * height, at.y - 0.5f * height), text,
                      label.c_str());
    }
    float taken = -HUGE_VALF;
    for (const double value : plot_ticks(frame.first, frame.last, false)) {
        const ImVec2 at = frame.place(value, frame.lower);
        const std::string label = short_number(value);
        const float half = 0.5f * ImGui::CalcTextSize(label.c_str()).x;
        list->AddLine(ImVec2(at.x, frame.corner.y), at, grid);
        if (at.x - half > taken && at.x + half < frame.end.x + height) {
            list->AddText(ImVec2(at.x - half, at.y + 0.2f * height), text, label.c_str());
            taken = at.x + half + height;
        }
    }
    list->AddRect(frame.corner, frame.end, ImGui::GetColorU32(ImGuiCol_Text, 0.5f));
}

void draw_curve(const PlotFrame& frame, const commands::SampledCurve& curve, ImU32 color, float width) {
    ImDrawList* list = ImGui::GetWindowDrawList();
    for (std::size_t i = 1; i < curve.points.size(); ++i) {
        const auto& a = curve.points[i - 1];
        const auto& b = curve.points[i];
        if (std::isfinite(a[1]) && std::isfinite(b[1])) {
            list->AddLine(frame.place(a[0], a[1]), frame.place(b[0], b[1]), color, width);
        }
    }
}

std::size_t nearest_row(const LineAnswer& answer, double arc_length) {
    const auto nearest = std::ranges::min_element(
        answer.rows, {}, [&](const commands::LineRow& row) { return std::abs(row.arc_length - arc_length); });
    return static_cast<std::size_t>(nearest - answer.rows.begin());
}

} // namespace

std::optional<std::size_t> draw_line_plot(Ui& ui, const LineAnswer& answer) {
    if (answer.rows.size() < 2) {
        return std::nullopt;
    }
    const float height = ImGui::GetTextLineHeight(), room = ImGui::GetContentRegionAvail().x;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(std::max(8 * height, room), 13 * height);
    ImGui::InvisibleButton("plot", size);
    explain(ui, "line/plot", "");
    PlotFrame frame;
    frame.first = answer.rows.front().arc_length;
    frame.last = answer.rows.back().arc_length;
    fit_values(frame, answer);
    float label_width = 0;
    for (const double value : plot_ticks(frame.lower, frame.upper, false)) {
        label_width = std::max(label_width, ImGui::CalcTextSize(short_number(value).c_str()).x);
    }
    frame.corner = ImVec2(corner.x + label_width + 0.6f * height, corner.y + 0.5f * height);
    frame.end = ImVec2(corner.x + size.x - 0.3f * height, corner.y + size.y - 1.6f * height);
    draw_axes(frame);
    for (std::size_t i = 0; i < answer.curves.size(); ++i) {
        draw_curve(frame, answer.curves[i], curve_colors[i % curve_colors.size()], 1.5f * ui.scale);
    }
    for (std::size_t i = 0; i < answer.curves.size(); ++i) {
        ImGui::PushStyleColor(ImGuiCol_Text, ImGui::ColorConvertU32ToFloat4(curve_colors[i % curve_colors.size()]));
        ImGui::TextWrapped("%s", answer.curves[i].name.c_str());
        ImGui::PopStyleColor();
    }
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (!ImGui::IsMouseHoveringRect(frame.corner, frame.end)) {
        return std::nullopt;
    }
    const std::size_t row = nearest_row(answer, frame.arc_length(mouse.x));
    const float x = frame.place(answer.rows[row].arc_length, frame.lower).x;
    ImGui::GetWindowDrawList()->AddLine(ImVec2(x, frame.corner.y), ImVec2(x, frame.end.y),
                                        ImGui::GetColorU32(ImGuiCol_Text, 0.6f));
    return row;
}

} // namespace elvis::view
