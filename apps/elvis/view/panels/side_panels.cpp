#include "panels.hpp"

#include <core/base/counted.hpp>
#include <core/base/vector3.hpp>

#include <cstdio>

namespace elvis::view {

namespace {

void saved_views(Ui& ui) {
    Model& model = ui.model();
    ImGui::Separator();
    ImGui::TextUnformatted("Views");
    ImGui::SameLine();
    if (small_button(ui, "camera/keep", "Keep this one", "Remembers the camera in the scene, under a name")) {
        Scene scene = ui.scene();
        scene["views"].push_back(
            {{"name", "view " + std::to_string(part_of(scene, "views").size() + 1)}, {"camera", scene["camera"]}});
        model.edit("keep view", std::move(scene));
        model.end_gesture();
    }
    Scene scene = ui.scene();
    bool is_changed = false;
    std::optional<std::size_t> removed;
    for (std::size_t i = 0; i < part_of(ui.scene(), "views").size(); ++i) {
        Json& view = scene["views"][i];
        ImGui::PushID(static_cast<int>(i));
        const std::string name = "camera/view" + std::to_string(i);
        if (small_button(ui, name + "/go", "Go", "Moves the camera there")) {
            model.set_camera(camera_of(view["camera"]));
        }
        ImGui::SameLine();
        auto words = view["name"].get<std::string>();
        is_changed = text(ui, name, "##name", words, "Its name") || is_changed;
        view["name"] = words;
        ImGui::SameLine();
        if (small_button(ui, name + "/remove", "-", "Forgets this view")) {
            removed = i;
        }
        ImGui::PopID();
    }
    if (removed) {
        scene["views"].erase(*removed);
    }
    if (removed || is_changed) {
        model.edit(removed ? "remove view" : "name view", std::move(scene));
    }
}

} // namespace

void draw_camera(Ui& ui) {
    Model& model = ui.model();
    if (!model.volume()) {
        return;
    }
    const Camera before = model.camera();
    Camera camera = before;
    const double extent = model.volume()->diagonal();
    bool is_changed = false;
    for (const StandardView& view : standard_views()) {
        if (button(ui, "camera/" + view.name, view.name.c_str(), "Looks at the whole volume from there")) {
            camera = ui.bench.fitted(from_standard_view(camera, view));
            is_changed = true;
        }
        ImGui::SameLine();
    }
    ImGui::NewLine();
    if (button(ui, "camera/fit", "Fit", "Moves the camera until the whole volume is seen (F)")) {
        camera = ui.bench.fitted(camera);
        is_changed = true;
    }
    ImGui::SameLine();
    if (button(ui, "camera/left", "Roll left", "Turns the picture by 15 degrees")) {
        camera = rolled(camera, -15);
        is_changed = true;
    }
    ImGui::SameLine();
    if (button(ui, "camera/right", "Roll right", "Turns the picture by 15 degrees")) {
        camera = rolled(camera, 15);
        is_changed = true;
    }
    bool is_orthographic = camera.orthographic;
    if (check(ui, "camera/orthographic", "Orthographic", is_orthographic, "Parallel rays; else those of an eye (O)")) {
        camera = with_projection(camera, is_orthographic);
        is_changed = true;
    }
    if (camera.orthographic) {
        is_changed = positive_number(ui, "camera/height", "Height", camera.height, extent, "Of the picture, in world units") ||
                     is_changed;
    } else {
        is_changed = slider(ui, "camera/angle", "Angle", camera.field_of_view, 1, 150,
                            "From the lower to the upper edge of the picture, in degrees") ||
                     is_changed;
    }
    is_changed = vector(ui, "camera/eye", "Eye", camera.eye, extent, "Where the picture is seen from") || is_changed;
    is_changed =
        vector(ui, "camera/look at", "Look at", camera.look_at, extent, "What is in the middle of the picture") || is_changed;
    is_changed = vector(ui, "camera/up", "Up", camera.up, 1, "What is up in the picture") || is_changed;
    // A camera that looks nowhere is not taken.
    const Vector3 view = minus(camera.look_at, camera.eye);
    if (is_changed && length(view) > 0 && length(cross(view, camera.up)) > 1e-6 * length(view) * length(camera.up)) {
        model.set_camera(camera);
    }
    ui.is_dragging = ui.is_dragging || (is_changed && ImGui::IsAnyItemActive());
    saved_views(ui);
}

void draw_picked(Ui& ui) {
    const std::optional<Picked>& picked = ui.bench.picked();
    if (!picked) {
        ImGui::TextWrapped("Click on a surface in the picture.");
        return;
    }
    const std::string& words = picked->text;
    if (button(ui, "point/copy", "Copy as text", "To the clipboard")) {
        ImGui::SetClipboardText(words.c_str());
    }
    if (picked->is_hit) {
        ImGui::SameLine();
        if (button(ui, "point/look at", "Look at it", "Turns the camera towards this point")) {
            Camera camera = ui.model().camera();
            const Vector3 by = minus(picked->position, camera.look_at);
            camera.look_at = picked->position;
            camera.eye = plus(camera.eye, by);
            ui.model().set_camera(camera);
        }
    }
    if (ImGui::BeginChild("point")) {
        ImGui::PushTextWrapPos(0);
        ImGui::TextUnformatted(words.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::EndChild();
}

namespace {

void draw_list(const std::vector<Message>& messages) {
    for (const Message& message : messages) {
        const ImVec4 plain = ImGui::GetStyleColorVec4(ImGuiCol_Text);
        const ImVec4 color = message.kind == Message::Kind::error     ? ImVec4(1.0f, 0.45f, 0.4f, 1.0f)
                             : message.kind == Message::Kind::warning ? ImVec4(0.95f, 0.7f, 0.2f, 1.0f)
                                                                      : plain;
        ImGui::PushStyleColor(ImGuiCol_Text, color);
        ImGui::TextWrapped("%s", message.text.c_str());
        ImGui::PopStyleColor();
    }
}

void draw_counts(const nlohmann::json& counts) {
    ImGui::TableSetupColumn("what", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("count", ImGuiTableColumnFlags_WidthFixed);
    const auto row = [&counts](const char* name, const char* of, bool is_always = true) {
        const auto count = counts.at(of).get<std::uint64_t>();
        if (is_always || count > 0) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(name);
            ImGui::TableNextColumn();
            ImGui::Text("%llu", static_cast<unsigned long long>(count));
        }
    };
    row("pixels", "pixels");
    row("pixels of surfaces", "hit_pixels");
    row("field evaluations", "field_evaluations");
    row("Newton iterations", "newton_iterations");
    row("Newton failures", "newton_failures");
    row("undecided pixels", "undecided_pixels");
    row("pixels of overlaps", "overlap_pixels");
    row("pixels that are not a number", "nan_pixels");
    row("pixels at the work limit", "work_limit_pixels");
    row("pixels that rest on estimates", "estimated_pixels", false);
    row("pixels of contours", "contour_pixels", false);
    row("undecided, of contours", "undecided_contour_pixels", false);
    row("pixels of mesh lines", "mesh_line_pixels", false);
    row("undecided, of mesh lines", "undecided_mesh_line_pixels", false);
    row("pixels of isosurfaces", "isosurface_pixels", false);
    row("undecided, of isosurfaces", "undecided_isosurface_pixels", false);
    row("pixels of the volume", "volume_pixels", false);
    row("beyond its tolerance", "inexact_volume_pixels", false);
}

} // namespace

void draw_statistics(Ui& ui) {
    const Workbench& bench = ui.bench;
    if (const auto& volume = ui.model().volume()) {
        ImGui::TextWrapped("%s: %s, read by %s", volume->path.c_str(), counted(volume->n_elements, "element").c_str(),
                           volume->plugin.c_str());
    }
    if (bench.stage() == FrameStage::exact &&
        ImGui::BeginTable("counts", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) {
        draw_counts(bench.picture().counts);
        ImGui::EndTable();
    }
    ImGui::Text("Last picture: %.1f ms", bench.picture().milliseconds);
    if (!bench.motion().frame_seconds.empty()) {
        ImGui::Text("While moving: %.1f pictures a second", bench.motion().frames_per_second());
    }
    if (bench.motion().rest_to_full_seconds) {
        ImGui::Text("From rest to all pixels: %.2f s", *bench.motion().rest_to_full_seconds);
    }
    if (bench.motion().rest_to_exact_seconds) {
        ImGui::Text("From rest to pixel-exact: %.2f s", *bench.motion().rest_to_exact_seconds);
    }
    ImGui::Separator();
    draw_list(bench.picture_messages());
    ImGui::Separator();
    ImGui::TextUnformatted("Messages");
    if (ImGui::BeginChild("messages")) {
        draw_list(bench.messages());
        if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) {
            ImGui::SetScrollHereY(1);
        }
    }
    ImGui::EndChild();
}

} // namespace elvis::view
