#include "view_area.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace elvis::view {

namespace {

/** A press that moves less than that, in units of ImGui, is a click. */
constexpr double click_distance = 4;
/** After the wheel has turned, the next turn may follow. */
constexpr double zoom_rest_seconds = 0.3;
constexpr float handle_radius = 7;

ImU32 rgba(int red, int green, int blue, int alpha = 255) { return IM_COL32(red, green, blue, alpha); }

} // namespace

bool ViewArea::is_moving() const {
    return (m_drag != Drag::none && m_dragged >= click_distance) ||
           (m_last_zoom >= 0 && ImGui::GetTime() - m_last_zoom < zoom_rest_seconds);
}

Camera ViewArea::camera(Ui& ui) const { return m_view == 0 ? ui.model().camera() : ui.bench.second().camera(ui.model()); }

void ViewArea::set_camera(Ui& ui, const Camera& camera) const {
    if (m_view == 0) {
        ui.model().set_camera(camera);
    } else {
        ui.bench.second().set_camera(ui.model(), camera);
    }
}

std::vector<Handle> ViewArea::handles(Ui& ui, const Scene& scene) const {
    std::vector<Handle> all;
    if (m_view != 0) {
        return all;
    }
    if (const std::optional<ItemId> item = ui.model().selection()) {
        all = handles_of(scene, *item, *ui.model().volume());
    }
    if (ui.bench.line) {
        const std::vector<Handle> ends = handles_of(*ui.bench.line);
        all.insert(all.end(), ends.begin(), ends.end());
    }
    return all;
}

void ViewArea::begin_drag(Ui& ui, const PicturePoint& place) {
    m_dragged = 0;
    m_handle.reset();
    const ImGuiIO& io = ImGui::GetIO();
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) {
        m_drag = Drag::pan;
    } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
        m_drag = Drag::zoom;
    } else {
        m_drag = io.KeyShift ? Drag::pan : io.KeyCtrl ? Drag::roll : Drag::orbit;
    }
    if (m_drag != Drag::orbit) {
        return;
    }
    const Camera seen_from = camera(ui);
    m_handles_before = handles(ui, ui.scene());
    double nearest = 1.6 * handle_radius * ui.scale * m_pixels;
    for (std::size_t i = 0; i < m_handles_before.size(); ++i) {
        if (const auto at = project(seen_from, m_size, m_handles_before[i].position)) {
            const double distance = std::hypot((*at)[0] - place[0], (*at)[1] - place[1]);
            if (distance < nearest) {
                nearest = distance;
                m_handle = i;
                m_drag = Drag::handle;
                m_before = ui.scene();
                m_taken = place;
            }
        }
    }
}

void ViewArea::drag_handle(Ui& ui, const PicturePoint& place) {
    Model& model = ui.model();
    const std::optional<ItemId> item = model.selection();
    const std::size_t n_ends = ui.bench.line ? 2 : 0, n_of_item = m_handles_before.size() - n_ends;
    const Vector3 position = dragged_to(m_handles_before[*m_handle], model.camera(), m_size, m_taken, place);
    if (*m_handle >= n_of_item) {
        ui.bench.line = with_moved_end(*ui.bench.line, *model.volume(), *m_handle - n_of_item, position);
    } else if (item) {
        Scene scene = model.as_seen(with_moved_handle(m_before, *item, *model.volume(), *m_handle, position));
        model.edit("move " + item_kind_name(scene, *item), std::move(scene));
    }
}

void ViewArea::go_on(Ui& ui, const PicturePoint& place, const PicturePoint& by) {
    const Camera before = camera(ui);
    switch (m_drag) {
    case Drag::orbit:
        set_camera(ui, orbited(before, m_size, by));
        break;
    case Drag::pan:
        set_camera(ui, panned(before, m_size, by));
        break;
    case Drag::zoom:
        set_camera(ui, zoomed(before, m_size, {0.5 * m_size.width, 0.5 * m_size.height},
                              std::exp(-3 * (by[0] - by[1]) / m_size.height)));
        break;
    case Drag::roll:
        set_camera(ui, rolled(before, 180 * by[0] / m_size.width));
        break;
    case Drag::handle:
        drag_handle(ui, place);
        break;
    case Drag::none:
        break;
    }
}

ImVec2 ViewArea::on_screen(const PicturePoint& place) const {
    return ImVec2(static_cast<float>(m_box.x + place[0]) / m_pixels, static_cast<float>(m_box.y + place[1]) / m_pixels);
}

void ViewArea::draw_picked_point(Ui& ui) const {
    const std::optional<Picked>& picked = ui.bench.picked();
    if (!picked || !picked->is_hit) {
        return;
    }
    if (const auto place = project(camera(ui), m_size, picked->position)) {
        ImDrawList* list = ImGui::GetWindowDrawList();
        const ImVec2 at = on_screen(*place);
        const float arm = 8 * ui.scale;
        for (const auto& [color, width] : {std::pair{rgba(255, 255, 255), 4.0f}, std::pair{rgba(0, 0, 0), 1.5f}}) {
            list->AddLine(ImVec2(at.x - arm, at.y), ImVec2(at.x + arm, at.y), color, width * ui.scale);
            list->AddLine(ImVec2(at.x, at.y - arm), ImVec2(at.x, at.y + arm), color, width * ui.scale);
        }
    }
}

void ViewArea::draw_line(Ui& ui) const {
    if (!ui.bench.line) {
        return;
    }
    const Camera seen_from = camera(ui);
    const auto from = project(seen_from, m_size, ui.bench.line->from), to = project(seen_from, m_size, ui.bench.line->to);
    ImDrawList* list = ImGui::GetWindowDrawList();
    if (from && to) {
        list->AddLine(on_screen(*from), on_screen(*to), rgba(0, 0, 0), 4 * ui.scale);
        list->AddLine(on_screen(*from), on_screen(*to), rgba(90, 200, 255), 2 * ui.scale);
    }
    const auto dot = [&](const Vector3& position, float radius, ImU32 color) {
        if (const auto place = project(seen_from, m_size, position)) {
            list->AddCircleFilled(on_screen(*place), radius + ui.scale, rgba(0, 0, 0));
            list->AddCircleFilled(on_screen(*place), radius, color);
        }
    };
    // Nor are those drawn of a place that the line has left.
    constexpr std::size_t most_dots = 300;
    const LineAnswer* const answer = ui.bench.line_answer();
    if (answer != nullptr && answer->line == *ui.bench.line && answer->breaks.size() <= most_dots) {
        for (const Vector3& place : answer->breaks) {
            dot(place, 2 * ui.scale, rgba(90, 200, 255));
        }
    }
    if (ui.line_point) {
        dot(*ui.line_point, 5 * ui.scale, rgba(255, 255, 255));
    }
}

void ViewArea::draw_handles(Ui& ui) {
    const Camera seen_from = camera(ui);
    ImDrawList* list = ImGui::GetWindowDrawList();
    const std::vector<Handle> all = handles(ui, ui.scene());
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float radius = handle_radius * ui.scale;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto place = project(seen_from, m_size, all[i].position);
        if (!place) {
            continue;
        }
        const ImVec2 at = on_screen(*place);
        if (all[i].tied_to) {
            if (const auto end = project(seen_from, m_size, *all[i].tied_to)) {
                list->AddLine(on_screen(*end), at, rgba(0, 0, 0), 4 * ui.scale);
                list->AddLine(on_screen(*end), at, rgba(255, 200, 40), 2 * ui.scale);
            }
        }
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto place = project(seen_from, m_size, all[i].position);
        if (!place) {
            continue;
        }
        const ImVec2 at = on_screen(*place);
        const bool is_near = std::hypot(mouse.x - at.x, mouse.y - at.y) < 1.6f * radius;
        const bool is_held = m_drag == Drag::handle && m_handle == i;
        list->AddCircleFilled(at, radius + 2 * ui.scale, rgba(0, 0, 0, 180));
        list->AddCircleFilled(at, radius, is_held || is_near ? rgba(255, 255, 255) : rgba(255, 200, 40));
        ui.places[std::string("handle/") + all[i].name] = {at.x - radius, at.y - radius, at.x + radius, at.y + radius};
        if (is_near && !is_held && m_drag == Drag::none && ImGui::IsItemHovered()) {
            ImGui::SetTooltip("%s", all[i].help);
        }
    }
}

namespace {

/** What is said of a picture: a word, the colour of its lamp, and what it means. */
struct StageMark {
    std::string words;
    ImU32 lamp;
    const char* help;
};

StageMark mark_of(const Workbench& bench, std::size_t view) {
    const ShownView& shown = bench.shown(view);
    const ImU32 amber = rgba(230, 160, 30), blue = rgba(80, 150, 240), green = rgba(60, 180, 75);
    if (shown.stage == FrameStage::none || (shown.stage != FrameStage::moving && !bench.has_shown_present(view))) {
        return {"drawing", amber, "The picture is out of date; another one is being drawn"};
    }
    switch (shown.stage) {
    case FrameStage::moving: {
        std::string words = "moving, 1 : ";
        words += std::to_string(shown.divisor);
        return {words, amber,
                "Stage 1 of 3: fewer pixels, perhaps without lines, to keep up with the hand. All comes when it rests"};
    }
    case FrameStage::full:
        return {"full", blue,
                "Stage 2 of 3: every pixel, with coarse lines and volume (to a hundredth of a colour). It is being refined"};
    default:
        return {"pixel-exact", green, "Stage 3 of 3: the picture that is saved, and that elvis render draws, to the byte"};
    }
}

} // namespace

void ViewArea::draw_stage(Ui& ui) const {
    const StageMark mark = mark_of(ui.bench, m_view);
    const float pad = 6 * ui.scale;
    const float height = ImGui::GetTextLineHeight();
    const ImVec2 corner(static_cast<float>(m_box.x) / m_pixels + pad, static_cast<float>(m_box.y) / m_pixels + pad);
    const float width = ImGui::CalcTextSize(mark.words.c_str()).x;
    const ImVec2 end(corner.x + width + height + 3 * pad, corner.y + height + 2 * pad);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(corner, end, rgba(30, 30, 30, 200), pad);
    list->AddCircleFilled(ImVec2(corner.x + pad + 0.5f * height, corner.y + pad + 0.5f * height), 0.35f * height, mark.lamp);
    list->AddText(ImVec2(corner.x + 2 * pad + height, corner.y + pad), rgba(255, 255, 255), mark.words.c_str());
    ui.places[m_view == 0 ? "stage" : "second stage"] = {corner.x, corner.y, end.x, end.y};
    if (m_drag == Drag::none && ImGui::IsItemHovered() && ImGui::IsMouseHoveringRect(corner, end)) {
        ImGui::SetTooltip("%s", mark.help);
    }
}

void ViewArea::draw(Ui& ui, float framebuffer_scale) {
    m_pixels = framebuffer_scale;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    m_box = {static_cast<int>(std::lround(corner.x * m_pixels)), static_cast<int>(std::lround(corner.y * m_pixels)),
             std::max(1, static_cast<int>(std::lround(room.x * m_pixels))),
             std::max(1, static_cast<int>(std::lround(room.y * m_pixels)))};
    m_size = {static_cast<double>(m_box.width), static_cast<double>(m_box.height)};
    ImGui::InvisibleButton("view", ImVec2(std::max(1.0f, room.x), std::max(1.0f, room.y)),
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle |
                               ImGuiButtonFlags_MouseButtonRight);
    explain(ui, m_view == 0 ? "view" : "second view", "");
    if (!ui.model().volume()) {
        return;
    }
    const ImGuiIO& io = ImGui::GetIO();
    const PicturePoint place = {double{io.MousePos.x} * m_pixels - m_box.x, double{io.MousePos.y} * m_pixels - m_box.y};
    if (ImGui::IsItemActivated()) {
        begin_drag(ui, place);
    }
    if (ImGui::IsItemActive() && m_drag != Drag::none) {
        m_dragged += std::hypot(io.MouseDelta.x, io.MouseDelta.y);
        if (m_dragged >= click_distance && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0)) {
            go_on(ui, place, {io.MouseDelta.x * m_pixels, io.MouseDelta.y * m_pixels});
        }
    }
    if (ImGui::IsItemDeactivated()) {
        if ((m_drag == Drag::orbit || m_drag == Drag::handle) && m_dragged < click_distance) {
            ui.bench.pick(place, m_view);
        }
        m_drag = Drag::none;
    }
    if (ImGui::IsItemHovered() && io.MouseWheel != 0) {
        set_camera(ui, zoomed(camera(ui), m_size, place, std::pow(0.88, double{io.MouseWheel})));
        m_last_zoom = ImGui::GetTime();
    }
    draw_picked_point(ui);
    draw_line(ui);
    draw_handles(ui);
    draw_stage(ui);
}

} // namespace elvis::view
