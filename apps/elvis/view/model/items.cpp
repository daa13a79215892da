#include "items.hpp"

#include <core/base/bounds.hpp>
#include <core/base/vector3.hpp>
#include <core/scene/color/color_map.hpp>
#include <core/scene/resolve.hpp>
#include <core/session/surface_names.hpp>

#include <algorithm>
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

/** Which of its kind it is. */
struct Detail {
    std::string operator()(const CutPlane& plane) const {
        const auto& [a, b, c, d] = plane.plane;
        const char* names[] = {"x", "y", "z"};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (plane.plane[axis] != 0 && plane.plane[(axis + 1) % 3] == 0 && plane.plane[(axis + 2) % 3] == 0) {
                return std::string(names[axis]) + " = " + number(-d / plane.plane[axis] + 0.0);
            }
        }
        return std::string("(") + number(a) + ", " + number(b) + ", " + number(c) + ")";
    }
    std::string operator()(const BoundaryFaces& boundary) const { return joined(boundary.groups); }
    std::string operator()(const Isosurfaces& isosurfaces) const {
        std::vector<std::string> values;
        for (const double value : isosurfaces.values) {
            values.push_back(number(value));
        }
        return joined(values);
    }
    std::string operator()(const FlatElements&) const { return {}; }
    std::string operator()(const ElementFaces&) const { return {}; }
    std::string operator()(const WireFrame&) const { return {}; }
    std::string operator()(const CutShape&) const { return {}; }
};

std::string detail(const SceneSurface& surface) {
    if (surface.streamlines && surface.name.empty()) {
        return surface.streamlines->flow;
    }
    return surface.name.empty() ? std::visit(Detail(), surface.geometry) : surface.name;
}

template <class T> T copied_after(std::vector<T>& list, std::size_t index) {
    const T copy = list[index];
    list.insert(list.begin() + static_cast<std::ptrdiff_t>(index) + 1, copy);
    return copy;
}

double least_extent(const VolumeFacts& volume) {
    const auto& b = volume.bounds;
    return std::max(std::min({b[3] - b[0], b[4] - b[1], b[5] - b[2]}), 1e-6 * volume.diagonal());
}

SurfaceGeometry new_geometry(const VolumeFacts& volume, NewItem item, double value) {
    const Vector3 middle = middle_of(volume.bounds);
    const double extent = least_extent(volume);
    const Vector3 along = {0, 0, 0.35 * extent};
    switch (item) {
    case NewItem::cut_plane:
        return central_plane(volume.bounds);
    case NewItem::sphere:
        return CutShape(Sphere{middle, 0.35 * extent});
    case NewItem::cylinder:
        return CutShape(Cylinder{minus(middle, along), plus(middle, along), 0.25 * extent, true});
    case NewItem::cone:
        return CutShape(Cone{minus(middle, along), plus(middle, along), 0.3 * extent, 0, true});
    case NewItem::torus:
        return CutShape(Torus{middle, {0, 0, 1}, 0.3 * extent, 0.1 * extent});
    case NewItem::quadric: {
        // An ellipsoid, so that every coefficient has something to act on.
        const double r = 0.35 * extent;
        const double constant = dot(middle, middle) - r * r;
        return CutShape(Quadric{{1, 1, 1, 0, 0, 0, -2 * middle[0], -2 * middle[1], -2 * middle[2], constant}});
    }
    case NewItem::implicit: {
        char text[120];
        std::snprintf(text, sizeof text, "z - (%.6g) - %.6g * sin(x / %.6g) * cos(y / %.6g)", middle[2], 0.1 * extent,
                      0.15 * extent, 0.15 * extent);
        return CutShape(ImplicitSurface{text});
    }
    case NewItem::elements:
        return ElementFaces{};
    case NewItem::wireframe:
        return WireFrame{};
    case NewItem::isosurface: {
        Isosurfaces isosurfaces;
        isosurfaces.values = {value};
        return isosurfaces;
    }
    case NewItem::streamlines:
        return CutShape(TubeSurface{});
    default:
        return BoundaryFaces{};
    }
}

/** As the reader makes them. */
SceneSurface new_surface(const VolumeFacts& volume, NewItem item, double value) {
    SceneSurface surface{new_geometry(volume, item, value)};
    if (item == NewItem::wireframe) {
        surface.color_map = uniform_color_map({0, 0, 0});
        surface.is_lit = false;
    }
    if (item == NewItem::streamlines) {
        surface.streamlines = SceneStreamlines{flows_of(volume).front()};
    }
    return surface;
}

} // namespace

std::vector<ItemId> items_of(const Scene& scene) {
    std::vector<ItemId> items;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        items.push_back({ItemKind::surface, i});
    }
    if (scene.volume_rendering) {
        items.push_back({ItemKind::volume, 0});
    }
    for (std::size_t i = 0; scene.lighting && i < scene.lighting->lights.size(); ++i) {
        items.push_back({ItemKind::light, i});
    }
    for (std::size_t i = 0; scene.lighting && i < scene.hidden_lights.size(); ++i) {
        items.push_back({ItemKind::hidden_light, i});
    }
    return items;
}

bool exists(const Scene& scene, const ItemId& item) {
    const std::vector<ItemId> items = items_of(scene);
    return std::find(items.begin(), items.end(), item) != items.end();
}

std::string item_kind_name(const Scene& scene, const ItemId& item) {
    switch (item.kind) {
    case ItemKind::surface: {
        const SceneSurface& surface = scene.surfaces[item.index];
        return surface.streamlines && surface.streamlines->times ? "pathlines" : elvis::kind_name(surface.geometry);
    }
    case ItemKind::volume:
        return "volume";
    default: {
        const Light& light =
            item.kind == ItemKind::light ? scene.lighting->lights[item.index] : scene.hidden_lights[item.index];
        return light.type == Light::Type::point ? "point light" : "directional light";
    }
    }
}

std::string item_label(const Scene& scene, const ItemId& item) {
    std::string text = item_kind_name(scene, item);
    text.front() = static_cast<char>(text.front() >= 'a' && text.front() <= 'z' ? text.front() - 'a' + 'A' : text.front());
    if (item.kind == ItemKind::surface) {
        const std::string more = detail(scene.surfaces[item.index]);
        text += more.empty() ? std::string() : std::string(" ") + more;
    } else if (item.kind == ItemKind::volume) {
        const std::optional<std::string>& field = scene.volume_rendering->field;
        text += field ? std::string(" ") + *field : std::string();
    }
    return text;
}

bool is_shown(const Scene& scene, const ItemId& item) {
    switch (item.kind) {
    case ItemKind::surface:
        return scene.surfaces[item.index].is_shown;
    case ItemKind::volume:
        return scene.volume_rendering->is_shown;
    default:
        return item.kind == ItemKind::light;
    }
}

ItemId set_shown(Scene& scene, const ItemId& item, bool shown) {
    if (item.kind == ItemKind::surface) {
        scene.surfaces[item.index].is_shown = shown;
        return item;
    }
    if (item.kind == ItemKind::volume) {
        scene.volume_rendering->is_shown = shown;
        return item;
    }
    if (is_shown(scene, item) == shown) {
        return item;
    }
    std::vector<Light>& from = shown ? scene.hidden_lights : scene.lighting->lights;
    std::vector<Light>& to = shown ? scene.lighting->lights : scene.hidden_lights;
    to.push_back(from[item.index]);
    from.erase(from.begin() + static_cast<std::ptrdiff_t>(item.index));
    return {shown ? ItemKind::light : ItemKind::hidden_light, to.size() - 1};
}

void remove(Scene& scene, const ItemId& item) {
    const auto at = static_cast<std::ptrdiff_t>(item.index);
    switch (item.kind) {
    case ItemKind::surface:
        scene.surfaces.erase(scene.surfaces.begin() + at);
        break;
    case ItemKind::volume:
        scene.volume_rendering.reset();
        break;
    case ItemKind::light:
        scene.lighting->lights.erase(scene.lighting->lights.begin() + at);
        break;
    case ItemKind::hidden_light:
        scene.hidden_lights.erase(scene.hidden_lights.begin() + at);
        break;
    }
}

ItemId duplicate(Scene& scene, const ItemId& item) {
    switch (item.kind) {
    case ItemKind::surface:
        copied_after(scene.surfaces, item.index);
        scene.surfaces[item.index + 1].name.clear(); // Names are of one surface each.
        return {item.kind, item.index + 1};
    case ItemKind::volume:
        return item;
    case ItemKind::light:
        copied_after(scene.lighting->lights, item.index);
        return {item.kind, item.index + 1};
    case ItemKind::hidden_light:
        copied_after(scene.hidden_lights, item.index);
        return {item.kind, item.index + 1};
    }
    return item;
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
        {NewItem::volume, "Volume", "The volume itself, as light that it emits and absorbs"},
        {NewItem::directional_light, "Directional light", "Light from far away"},
        {NewItem::point_light, "Point light", "Light from a place"}};
    return list;
}

std::vector<std::string> flows_of(const VolumeFacts& volume) {
    std::vector<std::string> flows, made;
    for (const FieldInfo& field : volume.fields) {
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
    for (const FieldInfo& field : volume.fields) {
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
    if (item == NewItem::streamlines) {
        return !flows_of(volume).empty();
    }
    return item != NewItem::volume || !scene.volume_rendering;
}

ItemId add(Scene& scene, const VolumeFacts& volume, NewItem item, double middle) {
    if (item == NewItem::volume) {
        scene.volume_rendering = SceneVolumeRendering{};
        return {ItemKind::volume, 0};
    }
    if (item == NewItem::directional_light || item == NewItem::point_light) {
        if (!scene.lighting) {
            scene.lighting = Lighting{};
        }
        Light light;
        if (item == NewItem::point_light) {
            light.type = Light::Type::point;
            light.vector = plus(middle_of(volume.bounds), scaled(unit({1, 1, 1}), volume.diagonal()));
        } else {
            light.vector = {-1, -1, -1};
        }
        light.color = {0.5, 0.5, 0.5};
        scene.lighting->lights.push_back(light);
        return {ItemKind::light, scene.lighting->lights.size() - 1};
    }
    scene.surfaces.push_back(new_surface(volume, item, middle));
    return {ItemKind::surface, scene.surfaces.size() - 1};
}

} // namespace elvis::view
