// Surfaces made of faces of elements: which ones.

#include "panels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace elvis::view {

namespace {

/** Whether a value is in a list, which is left out when it is empty. */
bool check_member(Ui& ui, const std::string& name, Json& part, const char* key, const std::string& value, const char* help) {
    auto list = part.value(key, std::vector<std::string>());
    const auto found = std::find(list.begin(), list.end(), value);
    bool is_member = found != list.end();
    if (!check(ui, name, value.c_str(), is_member, help)) {
        return false;
    }
    if (is_member) {
        list.push_back(value);
    } else {
        list.erase(found);
    }
    say(part, key, list.empty() ? std::nullopt : std::optional(list));
    return true;
}

bool edit_interval(Ui& ui, const std::string& name, const char* label, Json& part, const char* key,
                   const std::array<double, 2>& start, const char* help) {
    ImGui::PushID(name.c_str());
    bool is_changed = optional_part(ui, name, label, part, key, start, help);
    if (const auto interval = said<std::array<double, 2>>(part, key)) {
        ImGui::Indent();
        const double extent = std::max(start[1] - start[0], 1e-12);
        auto [lower, upper] = *interval;
        const bool has_lower = number(ui, name + "/lower", "from", lower, extent, help);
        const bool has_upper = number(ui, name + "/upper", "to", upper, extent, help);
        if (has_lower || has_upper) {
            part[key] = {std::min(lower, upper), std::max(lower, upper)};
            is_changed = true;
        }
        ImGui::Unindent();
    }
    ImGui::PopID();
    return is_changed;
}

/** As "3 7 10-20". */
std::string text_of(const Json& ids) {
    std::string text;
    for (const Json& id : ids) {
        text += text.empty() ? "" : " ";
        text += id.is_array() ? id[0].dump() + "-" + id[1].dump() : id.dump();
    }
    return text;
}

Json ids_of(const std::string& text) {
    Json ids = Json::array();
    const char* at = text.c_str();
    while (*at != '\0') {
        char* end = nullptr;
        if (*at < '0' || *at > '9') {
            ++at;
            continue;
        }
        const std::uint64_t first = std::strtoull(at, &end, 10);
        std::uint64_t last = first;
        at = end;
        if (*at == '-' && at[1] >= '0' && at[1] <= '9') {
            last = std::strtoull(at + 1, &end, 10);
            at = end;
        }
        ids.push_back(first == last ? Json(first) : Json{std::min(first, last), std::max(first, last)});
    }
    return ids;
}

bool edit_ids(Ui& ui, Json& surface) {
    std::string numbers = text_of(part_of(surface, "ids"));
    if (!text(ui, "elements/ids", "Numbers", numbers, "Numbers and ranges, such as 3 7 10-20; all if left empty", "all")) {
        return false;
    }
    const Json ids = ids_of(numbers);
    say(surface, "ids", ids.empty() ? std::nullopt : std::optional(ids));
    return true;
}

bool edit_orders(Ui& ui, Json& surface) {
    if (!edit_interval(ui, "elements/orders", "Order of the field", surface, "orders", {1, 4},
                       "Elements whose order is in this interval")) {
        return false;
    }
    if (const auto orders = said<std::array<double, 2>>(surface, "orders")) {
        const auto whole = [](double order) { return std::lround(std::clamp(order, -1.0, 1000.0)); };
        surface["orders"] = {whole((*orders)[0]), whole((*orders)[1])};
    }
    return true;
}

bool edit_box(Ui& ui, Json& surface) {
    const VolumeFacts& volume = *ui.model().volume();
    bool is_changed =
        optional_part(ui, "elements/box", "In a box", surface, "box", volume.bounds, "Elements whose bounds meet the box");
    if (auto box = said<std::array<double, 6>>(surface, "box")) {
        std::array<double, 6>& b = *box;
        Vector3 least = {b[0], b[1], b[2]}, most = {b[3], b[4], b[5]};
        const bool has_least = vector(ui, "elements/least", "least", least, volume.diagonal(), "The box's least corner");
        const bool has_most = vector(ui, "elements/most", "largest", most, volume.diagonal(), "The box's largest corner");
        for (std::size_t axis = 0; axis < 3 && (has_least || has_most); ++axis) {
            b[axis] = std::min(least[axis], most[axis]);
            b[axis + 3] = std::max(least[axis], most[axis]);
        }
        surface["box"] = b;
        is_changed = is_changed || has_least || has_most;
    }
    return is_changed;
}

constexpr const char* conditions[] = {"ids", "shapes", "negative_jacobian", "orders", "value_range", "box", "faces"};

} // namespace

bool edit_boundary(Ui& ui, Json& surface) {
    const std::vector<std::string>& groups = ui.model().volume()->boundary_groups;
    bool is_changed = false;
    if (groups.empty()) {
        return false;
    }
    ImGui::TextUnformatted(surface.contains("groups") ? "Groups" : "Groups: all");
    for (const std::string& group : groups) {
        is_changed =
            check_member(ui, "group/" + group, surface, "groups", group, "Without any, all of the boundary is drawn") ||
            is_changed;
    }
    return is_changed;
}

bool edit_elements(Ui& ui, Json& surface) {
    ImGui::TextWrapped("Elements for which all of this holds:");
    bool is_changed = edit_ids(ui, surface);
    for (const std::string& shape : ui.model().volume()->shapes) {
        is_changed = check_member(ui, "elements/" + shape, surface, "shapes", shape,
                                  "Elements of the shapes that are marked; without any mark, of all shapes") ||
                     is_changed;
    }
    is_changed = check(ui, "elements/negative", "Negative Jacobian", surface, "negative_jacobian", false,
                       "Only elements that are turned inside out somewhere") ||
                 is_changed;
    is_changed = edit_orders(ui, surface) || is_changed;
    const std::optional<FieldRange> range = ui.bench.range(said<std::string>(ui.scene(), "field"));
    is_changed = edit_interval(ui, "elements/values", "Value of the field", surface, "value_range",
                               range ? std::array<double, 2>{0.5 * (range->lower + range->upper), range->upper}
                                     : std::array<double, 2>{0, 1},
                               "Elements in which the field may take such values") ||
                 is_changed;
    is_changed = edit_box(ui, surface) || is_changed;
    return choice(ui, "elements/faces", "Faces", surface, "faces", {"all", "outer", "inner"},
                  "All of the chosen elements, those to others, or those between them") ||
           is_changed;
}

bool edit_wireframe(Ui& ui, Json& frame) {
    bool is_changed = slider(ui, "wires/width", "Width", frame, "width", 1, 1, 16, "In pixels");
    is_changed = check(ui, "wires/undeformed", "Without displacement", frame, "undeformed", false,
                       "Where they were before the volume was displaced") ||
                 is_changed;
    const auto is_said = [&](const char* key) { return frame.contains(key); };
    bool has_condition = std::ranges::any_of(conditions, is_said);
    if (check(ui, "wires/elements", "Of chosen elements", has_condition, "Else of the boundary")) {
        for (const char* const key : conditions) {
            frame.erase(key);
        }
        frame.erase("groups");
        if (has_condition) {
            frame["faces"] = "all";
        }
        is_changed = true;
    }
    return (has_condition ? edit_elements(ui, frame) : edit_boundary(ui, frame)) || is_changed;
}

} // namespace elvis::view
