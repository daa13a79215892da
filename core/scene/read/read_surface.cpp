#include <core/scene/color/color_map.hpp>
#include <core/scene/line_width.hpp>
#include <core/scene/read/read_parts.hpp>
#include <core/segment/tables.hpp>

namespace elvis {

namespace {

BoundaryFaces read_boundary(const JsonObject& object) {
    return {object.has("groups") ? object.texts("groups") : std::vector<std::string>()};
}

CutPlane read_plane(const JsonObject& object) {
    CutPlane plane;
    if (!object.has("plane") && !object.has("point") && !object.has("normal")) {
        object.fail("plane", "or 'point' and 'normal' must say where the plane is");
    }
    if (object.has("plane")) {
        plane.plane = fixed<4>(object.numbers("plane"));
    } else {
        const auto point = fixed<3>(object.numbers("point"));
        const auto normal = fixed<3>(object.numbers("normal"));
        plane.plane = {normal[0], normal[1], normal[2], -(normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2])};
    }
    if (plane.plane[0] == 0 && plane.plane[1] == 0 && plane.plane[2] == 0) {
        object.fail("plane", "has a normal of length zero");
    }
    return plane;
}

IsosurfaceMethod read_method(const JsonObject& object) {
    const std::string name = object.text("method");
    if (name != "interval" && name != "bernstein" && name != "companion") {
        object.fail("method", "is '" + name + "'; it can be interval, bernstein or companion");
    }
    return name == "interval"    ? IsosurfaceMethod::interval
           : name == "bernstein" ? IsosurfaceMethod::bernstein
                                 : IsosurfaceMethod::companion;
}

Isosurfaces read_isosurfaces(const JsonObject& object) {
    Isosurfaces isosurfaces;
    isosurfaces.values = object.numbers("values");
    std::sort(isosurfaces.values.begin(), isosurfaces.values.end());
    isosurfaces.skips_by_range = !object.has("range_skipping") || object.flag("range_skipping");
    if (object.has("method")) {
        isosurfaces.method = read_method(object);
    }
    if (object.has("degree")) {
        isosurfaces.degree = object.integer("degree");
        if (isosurfaces.degree == 1 || isosurfaces.degree > segment::max_degree) {
            object.fail("degree", "must be 0, or from 2 to 13");
        }
    }
    return isosurfaces;
}

} // namespace

SceneLineStyle read_line_style(const JsonObject& object) {
    SceneLineStyle style;
    if (object.has("width")) {
        style.width = object.number("width");
    }
    if (object.has("color")) {
        style.color = fixed<3>(object.numbers("color"));
    }
    if (object.has("undecided_color")) {
        style.undecided_color = fixed<3>(object.numbers("undecided_color"));
    }
    return style;
}

SceneLic read_lic(const JsonObject& object) {
    SceneLic lic;
    lic.field = object.text("field");
    if (object.has("length")) {
        lic.length = object.number("length");
    }
    if (object.has("contrast")) {
        lic.contrast = object.number("contrast");
    }
    return lic;
}

SceneContours read_contours(const JsonObject& object) {
    SceneContours contours;
    contours.is_round = !object.has("values") && !object.has("count");
    if (object.has("values")) {
        contours.values = object.numbers("values");
        if (!std::is_sorted(contours.values.begin(), contours.values.end())) {
            object.fail("values", "must be in ascending order");
        }
    } else if (object.has("count")) {
        contours.count = object.integer("count");
    }
    if (object.has("range")) {
        contours.range = fixed<2>(object.numbers("range"));
        if (!((*contours.range)[0] < (*contours.range)[1])) {
            object.fail("range", "must go from a smaller to a larger value");
        }
    }
    contours.style.width = object.has("width") ? object.number("width") : width_by_size;
    contours.has_map_color = object.has("color") && object.raw("color").is_string() && object.word("color") == "map";
    if (object.has("color") && !contours.has_map_color) {
        contours.style.color = fixed<3>(object.numbers("color"));
    }
    if (object.has("undecided_color")) {
        contours.style.undecided_color = fixed<3>(object.numbers("undecided_color"));
    }
    return contours;
}

SceneSurface read_surface(const JsonObject& object, const std::string& type, const std::string& scene) {
    SceneSurface surface;
    if (type == "plane") {
        surface.geometry = read_plane(object);
    } else if (type == "boundary") {
        surface.geometry = read_boundary(object);
    } else if (type == "elements") {
        surface.geometry = ElementFaces{read_selection(object)};
    } else if (type == "wireframe") {
        surface.geometry = read_wireframe(object);
        const Rgb color = object.has("color") ? fixed<3>(object.numbers("color")) : Rgb{0, 0, 0};
        surface.color_map = uniform_color_map(color);
        surface.is_lit = false;
    } else if (type == "isosurface") {
        surface.geometry = read_isosurfaces(object);
        if (object.has("color")) {
            surface.color_map = uniform_color_map(fixed<3>(object.numbers("color")));
        }
        if (object.has("color_field")) {
            surface.color_field = object.text("color_field");
        }
    } else if (type == "streamlines" || type == "pathlines") {
        surface.streamlines = type == "streamlines" ? read_streamlines(object) : read_pathlines(object);
        surface.geometry = surface.streamlines->ribbon_width ? CutShape(RibbonSurface{}) : CutShape(TubeSurface{});
        if (object.has("color")) {
            surface.color_map = uniform_color_map(fixed<3>(object.numbers("color")));
        }
    } else if (type == "arrows") {
        surface.geometry = ArrowSurface{};
        surface.arrows = read_arrows(object);
        if (object.has("color")) {
            surface.color_map = uniform_color_map(fixed<3>(object.numbers("color")));
        }
    } else {
        surface.geometry = read_shape(object, type, scene);
    }
    if (object.has("name")) {
        surface.name = object.text("name");
    }
    if (object.has("field")) {
        surface.field = object.text("field");
    }
    if (object.has("color_map")) {
        surface.color_map = read_color_map(object.object("color_map"), scene);
    }
    if (object.has("contours")) {
        surface.contours = read_contours(object.object("contours"));
    }
    if (object.has("mesh_lines")) {
        surface.mesh_lines = read_line_style(object.object("mesh_lines"));
    }
    if (object.has("lic")) {
        surface.lic = read_lic(object.object("lic"));
    }
    if (object.has("clip")) {
        for (const std::vector<double>& plane : object.rows("clip")) {
            surface.clip.push_back(fixed<4>(plane));
        }
    }
    if (object.has("opacity")) {
        surface.opacity = object.number("opacity");
    }
    if (object.has("outside")) {
        surface.outside = fixed<3>(object.numbers("outside"));
    }
    if (object.has("lighting")) {
        surface.is_lit = object.flag("lighting");
    }
    if (object.has("visible")) {
        surface.is_shown = object.flag("visible");
    }
    return surface;
}

} // namespace elvis
