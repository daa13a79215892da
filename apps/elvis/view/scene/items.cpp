#include "items.hpp"

#include <core/base/bounds.hpp>
#include <core/base/vector3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace elvis::view {

namespace {

std::string joined(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) {
        text += (text.empty() ? "" : ", ") + part;
    }
    return text;
}

std::string number(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

/** As people call surfaces, by their type in scenes; others are called as there. */
std::string type_name(const std::string& type) {
    return type == "plane" ? "cut plane" : type == "implicit" ? "implicit surface" : type == "bezier" ? "Bezier patches" : type;
}

std::string plane_text(const std::array<double, 4>& plane) {
    const char* names[] = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (plane[axis] != 0 && plane[(axis + 1) % 3] == 0 && plane[(axis + 2) % 3] == 0) {
            return std::string(names[axis]) + " = " + number(-plane[3] / plane[axis] + 0.0);
        }
    }
    return std::string("(") + number(plane[0]) + ", " + number(plane[1]) + ", " + number(plane[2]) + ")";
}

/** Which of its kind it is. */
std::string detail(const Json& surface) {
    const std::string type = surface["type"];
    if (const auto name = said<std::string>(surface, "name")) {
        return *name;
    }
    if (type == "plane") {
        return plane_text(surface["plane"]);
    }
    if (type == "isosurface") {
        std::vector<std::string> values;
        for (const Json& value : surface["values"]) {
            values.push_back(number(value));
        }
        return joined(values);
    }
    if (type == "boundary") {
        return joined(surface.value("groups", std::vector<std::string>()));
    }
    return surface.value("flow", surface.value("vectors", std::string()));
}

double least_extent(const VolumeFacts& volume) {
    const auto& b = volume.bounds;
    return std::max(std::min({b[3] - b[0], b[4] - b[1], b[5] - b[2]}), 1e-6 * volume.diagonal());
}

/** Of the bounds; what rounding leaves of a zero is zero. */
Vector3 middle_of_volume(const VolumeFacts& volume) {
    Vector3 middle = middle_of(volume.bounds);
    for (double& x : middle) {
        x = std::abs(x) < 1e-12 * volume.diagonal() ? 0 : x;
    }
    return middle;
}

/** Through the middle of the volume, across its shortest extent. */
std::array<double, 4> central_plane(const VolumeFacts& volume) {
    const auto& b = volume.bounds;
    std::size_t shortest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
        shortest = b[axis + 3] - b[axis] < b[shortest + 3] - b[shortest] ? axis : shortest;
    }
    std::array<double, 4> plane{};
    plane[shortest] = 1;
    plane[3] = 0 - middle_of_volume(volume)[shortest];
    return plane;
}

Json new_surface(const VolumeFacts& volume, NewItem item, double value) {
    const Vector3 middle = middle_of_volume(volume);
    const double extent = least_extent(volume);
    const Vector3 along = {0, 0, 0.35 * extent};
    const Vector3 from = minus(middle, along), to = plus(middle, along);
    switch (item) {
    case NewItem::cut_plane:
        return {{"type", "plane"}, {"plane", central_plane(volume)}};
    case NewItem::sphere:
        return {{"type", "sphere"}, {"center", middle}, {"radius", 0.35 * extent}};
    case NewItem::cylinder:
        return {{"type", "cylinder"}, {"from", from}, {"to", to}, {"radius", 0.25 * extent}};
    case NewItem::cone:
        return {{"type", "cone"}, {"from", from}, {"to", to}, {"from_radius", 0.3 * extent}, {"to_radius", 0}};
    case NewItem::torus:
        return {{"type", "torus"},
                {"center", middle},
                {"axis", {0, 0, 1}},
                {"major_radius", 0.3 * extent},
                {"minor_radius", 0.1 * extent}};
    case NewItem::quadric: {
        // An ellipsoid, so that every coefficient has something to act on.
        const double r = 0.35 * extent;
        const double constant = dot(middle, middle) - r * r;
        return {{"type", "quadric"},
                {"coefficients", {1, 1, 1, 0, 0, 0, -2 * middle[0], -2 * middle[1], -2 * middle[2], constant}}};
    }
    case NewItem::implicit: {
        char text[120];
        std::snprintf(text, sizeof text, "z - (%.6g) - %.6g * sin(x / %.6g) * cos(y / %.6g)", middle[2], 0.1 * extent,
                      0.15 * extent, 0.15 * extent);
        return {{"type", "implicit"}, {"expression", text}};
    }
    case NewItem::elements:
        return {{"type", "elements"}};
    case NewItem::wireframe:
        return {{"type", "wireframe"}};
    case NewItem::isosurface:
        return {{"type", "isosurface"}, {"values", {value}}};
    case NewItem::streamlines:
        return {{"type", "streamlines"}, {"flow", flows_of(volume).front()}};
    case NewItem::pathlines:
        return {{"type", "pathlines"}, {"flow", flows_of(volume).front()}};
    case NewItem::arrows:
        return {{"type", "arrows"}, {"vectors", flows_of(volume).front()}};
    default:
        return {{"type", "boundary"}};
    }
}

/** The list that holds items of that kind. */
Json& list_of(Scene& scene, ItemKind kind) {
    return kind == ItemKind::surface ? scene["surfaces"] : scene["lighting"]["lights"];
}

} // namespace

std::vector<ItemId> items_of(const Scene& scene) {
    std::vector<ItemId> items;
    for (std::size_t i = 0; i < part_of(scene, "surfaces").size(); ++i) {
        items.push_back({ItemKind::surface, i});
    }
    if (scene.contains("volume_rendering")) {
        items.push_back({ItemKind::volume, 0});
    }
    for (std::size_t i = 0; i < part_of(part_of(scene, "lighting"), "lights").size(); ++i) {
        items.push_back({ItemKind::light, i});
    }
    return items;
}

bool exists(const Scene& scene, const ItemId& item) {
    const std::vector<ItemId> items = items_of(scene);
    return std::find(items.begin(), items.end(), item) != items.end();
}

std::string pointer_of(const ItemId& item) {
    return item.kind == ItemKind::volume
               ? "/volume_rendering"
               : (item.kind == ItemKind::surface ? "/surfaces/" : "/lighting/lights/") + std::to_string(item.index);
}

const Json& part_of(const Scene& scene, const ItemId& item) { return scene.at(Json::json_pointer(pointer_of(item))); }
Json& part_of(Scene& scene, const ItemId& item) { return scene.at(Json::json_pointer(pointer_of(item))); }

std::string item_kind_name(const Scene& scene, const ItemId& item) {
    const std::string type = part_of(scene, item).value("type", "");
    return item.kind == ItemKind::surface ? type_name(type) : item.kind == ItemKind::light ? type + " light" : "volume";
}

std::string item_label(const Scene& scene, const ItemId& item) {
    std::string text = item_kind_name(scene, item);
    text.front() = static_cast<char>(text.front() >= 'a' && text.front() <= 'z' ? text.front() - 'a' + 'A' : text.front());
    const Json& part = part_of(scene, item);
    const std::string more = item.kind == ItemKind::surface  ? detail(part)
                             : item.kind == ItemKind::volume ? part.value("field", std::string())
                                                             : std::string();
    return more.empty() ? text : text + " " + more;
}

bool is_shown(const Scene& scene, const ItemId& item) { return part_of(scene, item).value("visible", true); }

void set_shown(Scene& scene, const ItemId& item, bool shown) {
    say(part_of(scene, item), "visible", shown ? std::nullopt : std::optional(false));
}

void remove(Scene& scene, const ItemId& item) {
    if (item.kind == ItemKind::volume) {
        scene.erase("volume_rendering");
        return;
    }
    Json& list = list_of(scene, item.kind);
    list.erase(item.index);
    if (list.empty()) {
        (item.kind == ItemKind::surface ? scene : scene["lighting"])
            .erase(item.kind == ItemKind::surface ? "surfaces" : "lights");
    }
}

ItemId duplicate(Scene& scene, const ItemId& item) {
    if (item.kind == ItemKind::volume) {
        return item;
    }
    Json copy = part_of(scene, item);
    copy.erase("name"); // Names are of one surface each.
    Json& list = list_of(scene, item.kind);
    list.insert(list.begin() + static_cast<std::ptrdiff_t>(item.index) + 1, std::move(copy));
    return {item.kind, item.index + 1};
}

const std::vector<NewItemInfo>& new_items() {
    static const std::vector<NewItemInfo> list = {
        {NewItem::boundary, "Boundary", "Faces without neighbour: the outside of the volume"},
        {NewItem::cut_plane, "Cut plane", "A plane through the volume, moved by a handle in the picture"},
        {NewItem::sphere, "Sphere", "A cut along a sphere"},
        {NewItem::cylinder, "Cylinder", "A cut along a cylinder"},
        {NewItem::cone, "Cone", "A cut along a cone"},
        {NewItem::torus, "Torus", "A cut along a torus"},
        {NewItem::quadric, "Quadric", "A cut along any surface of second degree"},
        {NewItem::implicit, "Implicit surface", "A cut where an expression of x, y and z is zero"},
        {NewItem::elements, "Elements", "Faces of elements that meet conditions"},
        {NewItem::wireframe, "Wireframe", "Curved edges of elements"},
        {NewItem::isosurface, "Isosurface", "Where the field takes given values"},
        {NewItem::streamlines, "Streamlines", "Curves that are everywhere tangent to a vector field, as tubes"},
        {NewItem::pathlines, "Pathlines", "The ways of points that move with a vector field through the time steps, as tubes"},
        {NewItem::arrows, "Arrows", "A vector field as arrows, evenly spaced in the volume or on a surface that has a name"},
        {NewItem::volume, "Volume", "The volume itself, as light that it emits and absorbs"},
        {NewItem::directional_light, "Directional light", "Light from far away"},
        {NewItem::point_light, "Point light", "Light from a place"}};
    return list;
}

std::vector<std::string> flows_of(const VolumeFacts& volume) {
    std::vector<std::string> flows, made;
    for (const FieldFacts& field : volume.fields) {
        if (field.n_components == 3 || (field.n_components == 2 && volume.dimension == 2)) {
            flows.push_back(field.name);
        }
        if (field.n_components == 3) {
            made.push_back("curl(" + field.name + ")");
        } else if (field.n_components == 1) {
            made.push_back("grad(" + field.name + ")");
        }
    }
    flows.insert(flows.end(), made.begin(), made.end());
    return flows;
}

std::vector<std::string> displacements_of(const VolumeFacts& volume) {
    std::vector<std::string> names;
    for (const FieldFacts& field : volume.fields) {
        if (field.n_components == 3 || (volume.dimension == 2 && field.n_components <= 2)) {
            names.push_back(field.name);
        }
    }
    return names;
}

bool can_add(const Scene& scene, const VolumeFacts& volume, NewItem item) {
    if (item == NewItem::directional_light || item == NewItem::point_light) {
        return true;
    }
    if (volume.dimension == 2) {
        return item == NewItem::elements || item == NewItem::wireframe;
    }
    if (item == NewItem::boundary || item == NewItem::elements || item == NewItem::wireframe) {
        return volume.has_faces;
    }
    if (item == NewItem::streamlines || item == NewItem::pathlines || item == NewItem::arrows) {
        return !flows_of(volume).empty() && (item != NewItem::pathlines || volume.times.size() > 1);
    }
    return item != NewItem::volume || !scene.contains("volume_rendering");
}

ItemId add(Scene& scene, const VolumeFacts& volume, NewItem item, double middle) {
    if (item == NewItem::volume) {
        scene["volume_rendering"] = Json::object();
        return {ItemKind::volume, 0};
    }
    if (item == NewItem::directional_light || item == NewItem::point_light) {
        Json light{{"type", "directional"}, {"direction", {-1, -1, -1}}, {"color", {0.5, 0.5, 0.5}}};
        if (item == NewItem::point_light) {
            light.erase("direction");
            light["type"] = "point";
            light["position"] = plus(middle_of(volume.bounds), scaled(unit({1, 1, 1}), volume.diagonal()));
        }
        Json& lights = list_of(scene, ItemKind::light);
        lights.push_back(std::move(light));
        return {ItemKind::light, lights.size() - 1};
    }
    Json& surfaces = list_of(scene, ItemKind::surface);
    surfaces.push_back(new_surface(volume, item, middle));
    return {ItemKind::surface, surfaces.size() - 1};
}

} // namespace elvis::view
