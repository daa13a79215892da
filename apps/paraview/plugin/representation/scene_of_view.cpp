#include "scene_of_view.hpp"

#include <nlohmann/json.hpp>

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkPiecewiseFunction.h>
#include <vtkRenderer.h>
#include <vtkScalarsToColors.h>

#include <algorithm>
#include <cmath>

namespace elvis_paraview {

namespace {

using Json = nlohmann::json;

/** Where the map's colours are not those of nodes and a space alone, they are linear in RGB between so many samples. */
constexpr int n_samples = 1024;

Json volume_of(const ShownItems& items) {
    Json json{{"path", items.files.at(0)}, {"time_step", items.time_step}};
    if (items.files.size() > 1) {
        json["more_paths"] = std::vector<std::string>(items.files.begin() + 1, items.files.end());
    }
    return json;
}

Json camera_of(vtkCamera& camera) {
    double eye[3], look_at[3], up[3];
    camera.GetPosition(eye);
    camera.GetFocalPoint(look_at);
    camera.GetViewUp(up);
    Json json{{"eye", eye}, {"look_at", look_at}, {"up", up}};
    if (camera.GetParallelProjection() != 0) {
        json["type"] = "orthographic";
        json["height"] = 2 * camera.GetParallelScale();
    } else {
        json["field_of_view"] = camera.GetViewAngle();
    }
    return json;
}

/** The word of scenes for where a map interpolates; null if they have none. */
const char* space_of(vtkColorTransferFunction& map) {
    switch (map.GetColorSpace()) {
    case VTK_CTF_RGB:
        return "rgb";
    case VTK_CTF_LAB:
        return "lab";
    case VTK_CTF_DIVERGING:
        return "diverging";
    case VTK_CTF_STEP:
        return "step";
    default:
        return nullptr;
    }
}

/** Points of a map that is linear between its nodes; empty for others. */
Json nodes_of(vtkColorTransferFunction& map, double lower, double upper) {
    Json points = Json::array();
    for (int index = 0; index < map.GetSize(); ++index) {
        double node[6];
        map.GetNodeValue(index, node);
        const bool is_linear = node[4] == 0.5 && node[5] == 0;
        if (!is_linear) {
            return Json::array();
        }
        points.push_back({(node[0] - lower) / (upper - lower), node[1], node[2], node[3]});
    }
    return points;
}

Json samples_of(vtkScalarsToColors& colors, double lower, double upper, bool is_logarithmic) {
    Json points = Json::array();
    for (int k = 0; k <= n_samples; ++k) {
        const double part = static_cast<double>(k) / n_samples;
        const double value = is_logarithmic ? lower * std::pow(upper / lower, part) : lower + part * (upper - lower);
        double rgb[3];
        // Without the steps into which ParaView divides its maps.
        if (auto* map = vtkColorTransferFunction::SafeDownCast(&colors)) {
            map->vtkColorTransferFunction::GetColor(value, rgb);
        } else {
            colors.GetColor(value, rgb);
        }
        points.push_back({part, rgb[0], rgb[1], rgb[2]});
    }
    return points;
}

Json color_map_of(vtkScalarsToColors& colors) {
    const double lower = colors.GetRange()[0], upper = colors.GetRange()[1];
    const bool is_logarithmic = colors.UsingLogScale() != 0;
    Json json{{"range", {lower, upper}}};
    if (is_logarithmic) {
        json["scale"] = "logarithmic";
    }
    if (!(upper > lower)) {
        double rgb[3];
        colors.GetColor(lower, rgb);
        json["points"] = {{0, rgb[0], rgb[1], rgb[2]}};
        return json;
    }
    auto* map = vtkColorTransferFunction::SafeDownCast(&colors);
    if (map != nullptr && !is_logarithmic && space_of(*map) != nullptr) {
        json["points"] = nodes_of(*map, lower, upper);
        json["space"] = space_of(*map);
    }
    if (!json.contains("points") || json["points"].empty()) {
        json["points"] = samples_of(colors, lower, upper, is_logarithmic);
        json["space"] = "rgb";
    }
    if (map != nullptr) {
        const double* nan = map->GetNanColor();
        json["nan"] = {nan[0], nan[1], nan[2]};
        if (map->GetUseBelowRangeColor() != 0) {
            const double* below = map->GetBelowRangeColor();
            json["below"] = {below[0], below[1], below[2]};
        }
        if (map->GetUseAboveRangeColor() != 0) {
            const double* above = map->GetAboveRangeColor();
            json["above"] = {above[0], above[1], above[2]};
        }
    }
    return json;
}

Json surfaces_of(const ShownItems& items) {
    Json surfaces = Json::array();
    const auto add = [&](Json surface, bool is_clipped) {
        if (is_clipped && !items.clip_planes.empty()) {
            surface["clip"] = items.clip_planes;
        }
        surface["lighting"] = items.is_lit;
        surfaces.push_back(std::move(surface));
    };
    if (items.has_boundary) {
        add({{"type", "boundary"}}, true);
    }
    for (const std::array<double, 4>& plane : items.cut_planes) {
        add({{"type", "plane"}, {"plane", plane}}, false);
    }
    if (!items.isovalues.empty()) {
        Json surface{{"type", "isosurface"}, {"values", items.isovalues}};
        if (!items.isosurface_field.empty()) {
            surface["field"] = items.isosurface_field;
            surface["color_field"] = items.field;
        }
        add(std::move(surface), true);
    }
    return surfaces;
}

/** By values of the field, linear between. */
Json opacity_of(vtkPiecewiseFunction& function) {
    // Scenes have no more than this at a point.
    constexpr double most = 1 - 1e-6;
    const auto point = [&](double value, double opacity) { return Json{value, std::clamp(opacity, 0.0, most)}; };
    Json points = Json::array();
    bool is_linear = true;
    for (int index = 0; index < function.GetSize(); ++index) {
        double node[4];
        function.GetNodeValue(index, node);
        is_linear = is_linear && node[2] == 0.5 && node[3] == 0;
        points.push_back(point(node[0], node[1]));
    }
    if (!is_linear) {
        const double lower = function.GetRange()[0], upper = function.GetRange()[1];
        points = Json::array();
        for (int k = 0; k <= n_samples; ++k) {
            const double value = lower + (upper - lower) * k / n_samples;
            points.push_back(point(value, function.GetValue(value)));
        }
    }
    return points;
}

Json scene_of(vtkRenderer& renderer, const ShownItems& items) {
    Json scene{{"version", 1},
               {"volume", volume_of(items)},
               {"precision", items.is_float64 ? "float64" : "float32"},
               {"camera", camera_of(*renderer.GetActiveCamera())},
               {"image", {{"size", size_of(renderer)}, {"background", {0, 0, 0, 0}}}}};
    if (!items.field.empty()) {
        scene["field"] = items.field;
    }
    if (items.colors != nullptr) {
        scene["color_map"] = color_map_of(*items.colors);
    } else {
        scene["color_map"] = {{"points", {{0, items.color[0], items.color[1], items.color[2]}}}};
    }
    return scene;
}

} // namespace

std::array<int, 2> size_of(vtkRenderer& renderer) {
    int width = 0, height = 0, left = 0, bottom = 0;
    renderer.GetTiledSizeAndOrigin(&width, &height, &left, &bottom);
    return {width, height};
}

std::string scene_of_view(vtkRenderer& renderer, const ShownItems& items, double diagonal, Part part) {
    Json scene = scene_of(renderer, items);
    if (part != Part::light) {
        scene["surfaces"] = surfaces_of(items);
        if (!items.contours.empty()) {
            scene["contours"] = {{"values", items.contours}};
        }
        if (items.has_mesh_lines) {
            scene["mesh_lines"] = Json::object();
        }
    }
    if (part != Part::surfaces && items.opacity != nullptr) {
        scene["volume_rendering"] = {{"opacity", opacity_of(*items.opacity)},
                                     {"unit_distance", items.unit_distance > 0 ? items.unit_distance : diagonal / 20}};
    }
    return scene.dump();
}

} // namespace elvis_paraview
