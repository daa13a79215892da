#include "panels.hpp"

#include <core/base/vector3.hpp>
#include <elvis/native/space.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::view {

namespace {

bool edit(Ui& ui, CutPlane& plane) {
    const double extent = ui.model().volume()->diagonal();
    bool is_changed = false;
    Vector3 normal = {plane.plane[0], plane.plane[1], plane.plane[2]};
    if (vector(ui, "plane/normal", "Normal", normal, 1, "Direction across the plane, of any length but zero") &&
        length(normal) > 0) {
        // The plane turns about its point nearest to the origin.
        const double before = length({plane.plane[0], plane.plane[1], plane.plane[2]});
        plane.plane = {normal[0], normal[1], normal[2], plane.plane[3] * length(normal) / before};
        is_changed = true;
    }
    const double size = length({plane.plane[0], plane.plane[1], plane.plane[2]});
    double offset = -plane.plane[3] / size;
    if (number(ui, "plane/offset", "Offset", offset, extent, "Distance of the plane from the origin, along its normal")) {
        plane.plane[3] = -offset * size;
        is_changed = true;
    }
    const auto& b = ui.model().volume()->bounds;
    const char* labels[] = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (axis > 0) {
            ImGui::SameLine();
        }
        if (button(ui, std::string("plane/") + labels[axis], labels[axis],
                   "Across this axis, through the middle of the volume")) {
            plane.plane = {};
            plane.plane[axis] = 1;
            plane.plane[3] = -0.5 * (b[axis] + b[axis + 3]);
            is_changed = true;
        }
    }
    ImGui::SameLine();
    if (button(ui, "plane/view", "view", "Facing the viewer, through what the camera looks at")) {
        const Camera camera = ui.model().camera();
        const Vector3 to_eye = scaled(axes_of(camera).forward, -1);
        plane.plane = {to_eye[0], to_eye[1], to_eye[2], -dot(to_eye, camera.look_at)};
        is_changed = true;
    }
    return is_changed;
}

/** Whether a value is in a list. */
template <class Value>
bool check_member(Ui& ui, const std::string& name, const char* label, std::vector<Value>& list, const Value& value,
                  const char* help) {
    const auto found = std::find(list.begin(), list.end(), value);
    bool is_member = found != list.end();
    if (!check(ui, name, label, is_member, help)) {
        return false;
    }
    if (is_member) {
        list.push_back(value);
    } else {
        list.erase(found);
    }
    return true;
}

bool edit(Ui& ui, BoundaryFaces& boundary) {
    const std::vector<std::string>& groups = ui.model().volume()->boundary_groups;
    bool is_changed = false;
    if (groups.empty()) {
        return false;
    }
    ImGui::TextUnformatted(boundary.groups.empty() ? "Groups: all" : "Groups");
    for (const std::string& group : groups) {
        is_changed = check_member(ui, "group/" + group, group.c_str(), boundary.groups, group,
                                  "Without any, all of the boundary is drawn") ||
                     is_changed;
    }
    return is_changed;
}

bool edit_interval(Ui& ui, const std::string& name, const char* label, std::optional<std::array<double, 2>>& interval,
                   const std::array<double, 2>& start, const char* help) {
    bool has = interval.has_value();
    ImGui::PushID(name.c_str());
    bool is_changed = check(ui, name, label, has, help);
    if (is_changed) {
        interval = has ? std::optional(start) : std::nullopt;
    }
    if (interval) {
        ImGui::Indent();
        const double extent = std::max(start[1] - start[0], 1e-12);
        double lower = (*interval)[0], upper = (*interval)[1];
        const bool has_lower = number(ui, name + "/lower", "from", lower, extent, help);
        const bool has_upper = number(ui, name + "/upper", "to", upper, extent, help);
        if (has_lower || has_upper) {
            interval = {std::min(lower, upper), std::max(lower, upper)};
            is_changed = true;
        }
        ImGui::Unindent();
    }
    ImGui::PopID();
    return is_changed;
}

using NumberRanges = decltype(ElementSelection::numbers);

/** As "3 7 10-20". */
std::string text_of(const NumberRanges& numbers) {
    std::string text;
    for (const auto& [first, last] : numbers) {
        text += text.empty() ? "" : " ";
        text += std::to_string(first);
        if (first != last) {
            text += '-';
            text += std::to_string(last);
        }
    }
    return text;
}

NumberRanges numbers_of(const std::string& text) {
    NumberRanges numbers;
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
        numbers.push_back({std::min(first, last), std::max(first, last)});
    }
    return numbers;
}

bool edit_orders(Ui& ui, ElementSelection& selection) {
    std::optional<std::array<double, 2>> orders;
    if (selection.orders) {
        orders = {double((*selection.orders)[0]), double((*selection.orders)[1])};
    }
    if (!edit_interval(ui, "elements/orders", "Order of the field", orders, {1, 4},
                       "Elements whose order is in this interval")) {
        return false;
    }
    selection.orders.reset();
    if (orders) {
        selection.orders = {static_cast<std::int32_t>(std::lround(std::clamp((*orders)[0], -1.0, 1000.0))),
                            static_cast<std::int32_t>(std::lround(std::clamp((*orders)[1], -1.0, 1000.0)))};
    }
    return true;
}

bool edit_box(Ui& ui, std::optional<std::array<double, 6>>& box) {
    const VolumeFacts& volume = *ui.model().volume();
    bool has_box = box.has_value();
    bool is_changed = check(ui, "elements/box", "In a box", has_box, "Elements whose bounds meet the box");
    if (is_changed) {
        box = has_box ? std::optional(volume.bounds) : std::nullopt;
    }
    if (box) {
        std::array<double, 6>& b = *box;
        Vector3 least = {b[0], b[1], b[2]}, most = {b[3], b[4], b[5]};
        const bool has_least = vector(ui, "elements/least", "least", least, volume.diagonal(), "The box's least corner");
        const bool has_most = vector(ui, "elements/most", "largest", most, volume.diagonal(), "The box's largest corner");
        for (std::size_t axis = 0; axis < 3 && (has_least || has_most); ++axis) {
            b[axis] = std::min(least[axis], most[axis]);
            b[axis + 3] = std::max(least[axis], most[axis]);
        }
        is_changed = is_changed || has_least || has_most;
    }
    return is_changed;
}

bool edit(Ui& ui, ElementSelection& selection) {
    bool is_changed = false;
    ImGui::TextWrapped("Elements for which all of this holds:");
    std::string numbers = text_of(selection.numbers);
    if (text(ui, "elements/ids", "Numbers", numbers, "Numbers and ranges, such as 3 7 10-20; all if left empty", "all")) {
        selection.numbers = numbers_of(numbers);
        is_changed = true;
    }
    for (const std::uint32_t shape : ui.model().volume()->shapes) {
        const std::string name(native::name(native::Shape{shape}));
        is_changed = check_member(ui, "elements/" + name, name.c_str(), selection.shapes, shape,
                                  "Elements of the shapes that are marked; without any mark, of all shapes") ||
                     is_changed;
    }
    is_changed = check(ui, "elements/negative", "Negative Jacobian", selection.has_negative_jacobian,
                       "Only elements that are turned inside out somewhere") ||
                 is_changed;
    is_changed = edit_orders(ui, selection) || is_changed;
    const std::optional<FieldRange> range = ui.bench.range(ui.scene().field);
    is_changed = edit_interval(ui, "elements/values", "Value of the field", selection.value_range,
                               range ? std::array<double, 2>{0.5 * (range->lower + range->upper), range->upper}
                                     : std::array<double, 2>{0, 1},
                               "Elements in which the field may take such values") ||
                 is_changed;
    is_changed = edit_box(ui, selection.box) || is_changed;
    static const std::vector<std::string> words = {"all", "outer", "inner"};
    auto faces = static_cast<std::size_t>(selection.faces);
    if (choice(ui, "elements/faces", "Faces", faces, words,
               "All of the chosen elements, those to others, or those between them")) {
        selection.faces = static_cast<ElementSelection::Faces>(faces);
        is_changed = true;
    }
    return is_changed;
}

bool edit(Ui& ui, ElementFaces& elements) { return edit(ui, elements.selection); }

bool edit(Ui&, const FlatElements&) { return false; }

bool edit(Ui& ui, WireFrame& frame) {
    bool is_changed = slider(ui, "wires/width", "Width", frame.width, 1, 16, "In pixels");
    bool has_condition = std::holds_alternative<ElementFaces>(frame.faces);
    if (check(ui, "wires/elements", "Of chosen elements", has_condition, "Else of the boundary")) {
        if (has_condition) {
            // Without any condition a file would mean the boundary.
            ElementFaces elements;
            elements.selection.box = ui.model().volume()->bounds;
            frame.faces = elements;
        } else {
            frame.faces = BoundaryFaces{};
        }
        is_changed = true;
    }
    return std::visit([&](auto& faces) { return edit(ui, faces); }, frame.faces) || is_changed;
}

bool edit(Ui& ui, Sphere& sphere) {
    const double extent = ui.model().volume()->diagonal();
    bool is_changed = vector(ui, "shape/center", "Centre", sphere.center, extent, "Of the sphere");
    return positive_number(ui, "shape/radius", "Radius", sphere.radius, extent, "Of the sphere") || is_changed;
}

bool edit(Ui& ui, Cylinder& cylinder) {
    const double extent = ui.model().volume()->diagonal();
    const Cylinder before = cylinder;
    bool is_changed = vector(ui, "shape/from", "From", cylinder.from, extent, "Middle of one end");
    is_changed = vector(ui, "shape/to", "To", cylinder.to, extent, "Middle of the other end") || is_changed;
    is_changed = positive_number(ui, "shape/radius", "Radius", cylinder.radius, extent, "Of the cylinder") || is_changed;
    is_changed = check(ui, "shape/capped", "Closed", cylinder.is_capped, "Whether discs close its ends") || is_changed;
    if (cylinder.from == cylinder.to) {
        cylinder = before;
    }
    return is_changed;
}

bool edit(Ui& ui, Cone& cone) {
    const double extent = ui.model().volume()->diagonal();
    const Cone before = cone;
    bool is_changed = vector(ui, "shape/from", "From", cone.from, extent, "Middle of one end");
    is_changed = vector(ui, "shape/to", "To", cone.to, extent, "Middle of the other end") || is_changed;
    is_changed = number(ui, "shape/from radius", "Radius there", cone.from_radius, extent, "At the first end") || is_changed;
    is_changed = number(ui, "shape/to radius", "and there", cone.to_radius, extent, "At the other end") || is_changed;
    is_changed = check(ui, "shape/capped", "Closed", cone.is_capped, "Whether discs close its ends") || is_changed;
    if (cone.from == cone.to || cone.from_radius < 0 || cone.to_radius < 0 || (cone.from_radius == 0 && cone.to_radius == 0)) {
        cone = before;
    }
    return is_changed;
}

bool edit(Ui& ui, Torus& torus) {
    const double extent = ui.model().volume()->diagonal();
    const Torus before = torus;
    bool is_changed = vector(ui, "shape/center", "Centre", torus.center, extent, "Of the torus");
    is_changed = vector(ui, "shape/axis", "Axis", torus.axis, 1, "Of any length but zero") || is_changed;
    is_changed =
        positive_number(ui, "shape/radius", "Ring", torus.major_radius, extent, "From the centre to the middle of the tube") ||
        is_changed;
    is_changed = positive_number(ui, "shape/tube", "Tube", torus.minor_radius, extent, "Radius of the tube") || is_changed;
    if (length(torus.axis) == 0) {
        torus = before;
    }
    return is_changed;
}

bool edit(Ui& ui, Quadric& quadric) {
    static const char* names[] = {"xx", "yy", "zz", "xy", "yz", "zx", "x", "y", "z", "1"};
    bool is_changed = false;
    const Quadric before = quadric;
    for (std::size_t i = 0; i < 10; ++i) {
        is_changed = number(ui, std::string("shape/") + names[i], names[i], quadric.coefficients[i], 1,
                            "Coefficient of this in the sum that is zero on the surface") ||
                     is_changed;
    }
    if (std::all_of(quadric.coefficients.begin(), quadric.coefficients.begin() + 9, [](double a) { return a == 0; })) {
        quadric = before;
    }
    return is_changed;
}

bool edit(Ui& ui, ImplicitSurface& implicit) {
    return text(ui, "shape/expression", "Zero of", implicit.expression, "An expression of x, y and z");
}

/** Of a file that is not edited. */
bool show_file(const std::string& path) {
    ImGui::TextWrapped("%s", path.c_str());
    return false;
}

bool edit(Ui&, const MeshSurface& surface) { return show_file(surface.mesh->path); }

bool edit(Ui&, const BezierSurface& surface) { return show_file(surface.mesh->path); }
/** See streamlines.cpp. */
bool edit(Ui&, const TubeSurface&) { return false; }
bool edit(Ui&, const ArrowSurface&) { return false; }

bool edit(Ui& ui, CutShape& shape) {
    return std::visit([&](auto& kind) { return edit(ui, kind); }, shape);
}

bool edit(Ui& ui, Isosurfaces& isosurfaces) {
    std::vector<double> values = isosurfaces.values;
    bool is_changed = false;
    if (number_list(ui, "isosurface/values", "Values", values, "What the field is there; several are separated by blanks") &&
        !values.empty()) {
        isosurfaces.values = values;
        is_changed = true;
    }
    const std::optional<ItemId> item = ui.model().selection();
    const std::optional<std::string>& own = ui.scene().surfaces[item->index].field;
    const std::optional<FieldRange> range = ui.bench.range(own ? own : ui.scene().field);
    if (range && range->lower < range->upper) {
        for (std::size_t i = 0; i < isosurfaces.values.size() && i < 8; ++i) {
            const std::string label = std::string("##value").append(std::to_string(i));
            double value = isosurfaces.values[i];
            if (slider(ui, "isosurface/value" + std::to_string(i), label.c_str(), value, range->lower, range->upper,
                       "Moves this value through the range of the field")) {
                // Neighbours are passed only in the list above: their order is that of the sliders.
                const double least = i > 0 ? std::nextafter(isosurfaces.values[i - 1], value) : range->lower;
                const double most =
                    i + 1 < isosurfaces.values.size() ? std::nextafter(isosurfaces.values[i + 1], value) : range->upper;
                isosurfaces.values[i] = std::clamp(value, std::min(least, most), std::max(least, most));
                is_changed = true;
            }
        }
    }
    return is_changed;
}

} // namespace

bool edit_geometry(Ui& ui, SceneSurface& surface) {
    return std::visit([&](auto& kind) { return edit(ui, kind); }, surface.geometry);
}

bool edit_light(Ui& ui, Light& light) {
    const bool is_point = light.type == Light::Type::point;
    Vector3 place = light.vector;
    bool is_changed = false;
    if (vector(ui, "light/place", is_point ? "Place" : "Direction", place, is_point ? ui.model().volume()->diagonal() : 1,
               is_point ? "Where the light is" : "In which the light travels") &&
        (is_point || length(place) > 0)) {
        light.vector = place;
        is_changed = true;
    }
    return color(ui, "light/color", "Colour", light.color, "Of the light") || is_changed;
}

} // namespace elvis::view
