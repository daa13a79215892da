#include "panels.hpp"

#include <core/base/vector3.hpp>

#include <algorithm>
#include <cmath>

namespace elvis::view {

namespace {

double extent_of(Ui& ui) { return ui.model().volume()->diagonal(); }

bool edit_plane(Ui& ui, Json& surface) {
    std::array<double, 4> plane = surface["plane"];
    bool is_changed = false;
    Vector3 normal = {plane[0], plane[1], plane[2]};
    const double before = length(normal);
    if (vector(ui, "plane/normal", "Normal", normal, 1, "Direction across the plane, of any length but zero") &&
        length(normal) > 0) {
        // The plane turns about its point nearest to the origin.
        plane = {normal[0], normal[1], normal[2], plane[3] * length(normal) / before};
        is_changed = true;
    }
    const double size = length({plane[0], plane[1], plane[2]});
    double offset = -plane[3] / size;
    if (number(ui, "plane/offset", "Offset", offset, extent_of(ui),
               "Distance of the plane from the origin, along its normal")) {
        plane[3] = -offset * size;
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
            plane = {};
            plane[axis] = 1;
            plane[3] = -0.5 * (b[axis] + b[axis + 3]);
            is_changed = true;
        }
    }
    ImGui::SameLine();
    if (button(ui, "plane/view", "view", "Facing the viewer, through what the camera looks at")) {
        const Camera camera = ui.model().camera();
        const Vector3 to_eye = scaled(axes_of(camera).forward, -1);
        plane = {to_eye[0], to_eye[1], to_eye[2], -dot(to_eye, camera.look_at)};
        is_changed = true;
    }
    if (is_changed) {
        surface["plane"] = plane;
    }
    return is_changed;
}

bool edit_sphere(Ui& ui, Json& sphere) {
    const bool is_changed = vector(ui, "shape/center", "Centre", sphere, "center", extent_of(ui), "Of the sphere");
    return positive_number(ui, "shape/radius", "Radius", sphere, "radius", extent_of(ui), "Of the sphere") || is_changed;
}

bool edit_ends(Ui& ui, Json& surface) {
    const bool is_changed = vector(ui, "shape/from", "From", surface, "from", extent_of(ui), "Middle of one end");
    return vector(ui, "shape/to", "To", surface, "to", extent_of(ui), "Middle of the other end") || is_changed;
}

bool edit_cylinder(Ui& ui, Json& cylinder) {
    const Json before = cylinder;
    bool is_changed = edit_ends(ui, cylinder);
    is_changed =
        positive_number(ui, "shape/radius", "Radius", cylinder, "radius", extent_of(ui), "Of the cylinder") || is_changed;
    is_changed = check(ui, "shape/capped", "Closed", cylinder, "capped", true, "Whether discs close its ends") || is_changed;
    if (cylinder["from"] == cylinder["to"]) {
        cylinder = before;
    }
    return is_changed;
}

bool edit_cone(Ui& ui, Json& cone) {
    const Json before = cone;
    bool is_changed = edit_ends(ui, cone);
    is_changed = number(ui, "shape/from radius", "Radius there", cone, "from_radius", 0, extent_of(ui), "At the first end") ||
                 is_changed;
    is_changed =
        number(ui, "shape/to radius", "and there", cone, "to_radius", 0, extent_of(ui), "At the other end") || is_changed;
    is_changed = check(ui, "shape/capped", "Closed", cone, "capped", true, "Whether discs close its ends") || is_changed;
    const double from_radius = cone.value("from_radius", 0.0), to_radius = cone.value("to_radius", 0.0);
    if (cone["from"] == cone["to"] || from_radius < 0 || to_radius < 0 || (from_radius == 0 && to_radius == 0)) {
        cone = before;
    }
    return is_changed;
}

bool edit_torus(Ui& ui, Json& torus) {
    const double extent = extent_of(ui);
    const Json before = torus;
    bool is_changed = vector(ui, "shape/center", "Centre", torus, "center", extent, "Of the torus");
    is_changed = vector(ui, "shape/axis", "Axis", torus, "axis", 1, "Of any length but zero") || is_changed;
    is_changed = positive_number(ui, "shape/radius", "Ring", torus, "major_radius", extent,
                                 "From the centre to the middle of the tube") ||
                 is_changed;
    is_changed = positive_number(ui, "shape/tube", "Tube", torus, "minor_radius", extent, "Radius of the tube") || is_changed;
    if (length(torus["axis"].get<Vector3>()) == 0) {
        torus = before;
    }
    return is_changed;
}

bool edit_quadric(Ui& ui, Json& quadric) {
    static const char* names[] = {"xx", "yy", "zz", "xy", "yz", "zx", "x", "y", "z", "1"};
    auto coefficients = quadric["coefficients"].get<std::array<double, 10>>();
    bool is_changed = false;
    for (std::size_t i = 0; i < 10; ++i) {
        is_changed = number(ui, std::string("shape/") + names[i], names[i], coefficients[i], 1,
                            "Coefficient of this in the sum that is zero on the surface") ||
                     is_changed;
    }
    if (is_changed && !std::all_of(coefficients.begin(), coefficients.begin() + 9, [](double a) { return a == 0; })) {
        quadric["coefficients"] = coefficients;
    }
    return is_changed;
}

bool edit_isosurface(Ui& ui, Json& surface) {
    auto values = surface["values"].get<std::vector<double>>();
    bool is_changed = false;
    if (number_list(ui, "isosurface/values", "Values", values, "What the field is there; several are separated by blanks") &&
        !values.empty()) {
        surface["values"] = values;
        is_changed = true;
    }
    const auto own = said<std::string>(surface, "field");
    const std::optional<FieldRange> range = ui.bench.range(own ? own : said<std::string>(ui.scene(), "field"));
    if (!range || !(range->lower < range->upper)) {
        return is_changed;
    }
    for (std::size_t i = 0; i < values.size() && i < 8; ++i) {
        const std::string label = std::string("##value").append(std::to_string(i));
        double value = values[i];
        if (slider(ui, "isosurface/value" + std::to_string(i), label.c_str(), value, range->lower, range->upper,
                   "Moves this value through the range of the field")) {
            // Neighbours are passed only in the list above: their order is that of the sliders.
            const double least = i > 0 ? std::nextafter(values[i - 1], value) : range->lower;
            const double most = i + 1 < values.size() ? std::nextafter(values[i + 1], value) : range->upper;
            values[i] = std::clamp(value, std::min(least, most), std::max(least, most));
            surface["values"] = values;
            is_changed = true;
        }
    }
    return is_changed;
}

} // namespace

bool edit_geometry(Ui& ui, Json& surface) {
    static const std::map<std::string, bool (*)(Ui&, Json&)> editors = {{"plane", edit_plane},
                                                                        {"sphere", edit_sphere},
                                                                        {"cylinder", edit_cylinder},
                                                                        {"cone", edit_cone},
                                                                        {"torus", edit_torus},
                                                                        {"quadric", edit_quadric},
                                                                        {"isosurface", edit_isosurface},
                                                                        {"boundary", edit_boundary},
                                                                        {"elements", edit_elements},
                                                                        {"wireframe", edit_wireframe},
                                                                        {"streamlines", edit_streamlines},
                                                                        {"pathlines", edit_streamlines},
                                                                        {"arrows", edit_arrows}};
    const std::string type = surface["type"];
    if (type == "implicit") {
        auto expression = surface["expression"].get<std::string>();
        const bool is_changed = text(ui, "shape/expression", "Zero of", expression, "An expression of x, y and z");
        surface["expression"] = expression;
        return is_changed;
    }
    if (surface.contains("file")) {
        ImGui::TextWrapped("%s", surface["file"].get<std::string>().c_str());
    }
    const auto found = editors.find(type);
    return found != editors.end() && found->second(ui, surface);
}

bool edit_light(Ui& ui, Json& light) {
    const bool is_point = light["type"] == "point";
    const char* const key = is_point ? "position" : "direction";
    Vector3 place = light[key];
    bool is_changed = false;
    if (vector(ui, "light/place", is_point ? "Place" : "Direction", place, is_point ? extent_of(ui) : 1,
               is_point ? "Where the light is" : "In which the light travels") &&
        (is_point || length(place) > 0)) {
        light[key] = place;
        is_changed = true;
    }
    return color(ui, "light/color", "Colour", light, "color", {1, 1, 1}, "Of the light") || is_changed;
}

} // namespace elvis::view
