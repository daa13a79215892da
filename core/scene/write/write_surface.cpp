#include <core/scene/write/write_parts.hpp>

#include <core/base/overloaded.hpp>
#include <elvis/native/space.hpp>

namespace elvis {

namespace {

void add_groups(SceneJson& json, const BoundaryFaces& boundary) {
    if (!boundary.groups.empty()) {
        json["groups"] = boundary.groups;
    }
}

void add_selection(SceneJson& json, const ElementSelection& selection) {
    for (const auto& [first, last] : selection.numbers) {
        json["ids"].push_back(first == last ? SceneJson(first) : SceneJson{first, last});
    }
    for (const std::uint32_t shape : selection.shapes) {
        json["shapes"].push_back(native::name(native::Shape{shape}));
    }
    if (selection.orders) {
        json["orders"] = *selection.orders;
    }
    if (selection.has_negative_jacobian) {
        json["negative_jacobian"] = true;
    }
    if (selection.value_range) {
        json["value_range"] = *selection.value_range;
    }
    if (selection.box) {
        json["box"] = *selection.box;
    }
    json["faces"] = selection.faces == ElementSelection::Faces::all     ? "all"
                    : selection.faces == ElementSelection::Faces::outer ? "outer"
                                                                        : "inner";
}

void add_wireframe(SceneJson& json, const WireFrame& frame) {
    json["width"] = frame.width;
    if (frame.is_undeformed) {
        json["undeformed"] = true;
    }
    std::visit(Overloaded{[&](const BoundaryFaces& boundary) { add_groups(json, boundary); }, [](const FlatElements&) {},
                          [&](const ElementFaces& elements) { add_selection(json, elements.selection); }},
               frame.faces);
}

void add_isosurfaces(SceneJson& json, const Isosurfaces& isosurfaces) {
    json["values"] = isosurfaces.values;
    if (!isosurfaces.skips_by_range) {
        json["range_skipping"] = false;
    }
    if (isosurfaces.method != IsosurfaceMethod::interval) {
        json["method"] = isosurfaces.method == IsosurfaceMethod::bernstein ? "bernstein" : "companion";
    }
    if (isosurfaces.degree != 0) {
        json["degree"] = isosurfaces.degree;
    }
}

SceneJson shape_json(const CutShape& shape, const std::string& scene) {
    return std::visit(
        Overloaded{[](const Sphere& s) {
                       return SceneJson{{"type", "sphere"}, {"center", s.center}, {"radius", s.radius}};
                   },
                   [](const Cylinder& s) {
                       return SceneJson{
                           {"type", "cylinder"}, {"from", s.from}, {"to", s.to}, {"radius", s.radius}, {"capped", s.is_capped}};
                   },
                   [](const Cone& s) {
                       return SceneJson{
                           {"type", "cone"},           {"from", s.from},       {"to", s.to}, {"from_radius", s.from_radius},
                           {"to_radius", s.to_radius}, {"capped", s.is_capped}};
                   },
                   [](const Quadric& s) {
                       return SceneJson{{"type", "quadric"}, {"coefficients", s.coefficients}};
                   },
                   [](const Torus& s) {
                       return SceneJson{{"type", "torus"},
                                        {"center", s.center},
                                        {"axis", s.axis},
                                        {"major_radius", s.major_radius},
                                        {"minor_radius", s.minor_radius}};
                   },
                   [](const ImplicitSurface& s) {
                       return SceneJson{{"type", "implicit"}, {"expression", s.expression}};
                   },
                   [&](const MeshSurface& s) {
                       return SceneJson{{"type", "mesh"}, {"file", seen_from(scene, s.mesh->path)}};
                   },
                   [&](const BezierSurface& s) {
                       return SceneJson{{"type", "bezier"}, {"file", seen_from(scene, s.mesh->path)}};
                   },
                   [](const TubeSurface&) {
                       return SceneJson{{"type", "streamlines"}};
                   },
                   [](const RibbonSurface&) {
                       return SceneJson{{"type", "streamlines"}};
                   },
                   [](const ArrowSurface&) {
                       return SceneJson{{"type", "arrows"}};
                   }},
        shape);
}

void add_streamlines(SceneJson& json, const SceneStreamlines& lines) {
    constexpr const char* words[] = {"both", "forward", "backward"};
    json["flow"] = lines.flow;
    if (!lines.seeds.empty()) {
        json["seeds"] = lines.seeds;
    } else if (lines.seed_line) {
        json["seed_line"] = *lines.seed_line;
        json["seed_count"] = lines.seed_count;
    } else if (lines.on.empty() && !lines.spacing) {
        json["seed_grid"] = lines.seed_grid;
    }
    if (!lines.on.empty()) {
        json["on"] = lines.on;
    }
    set(json, "spacing", lines.spacing);
    json["direction"] = words[static_cast<std::size_t>(lines.direction)];
    set(json, "length", lines.length);
    json["tolerance"] = lines.tolerance;
    set(json, "radius", lines.radius);
    set(json, "ribbon_width", lines.ribbon_width);
    if (lines.times) {
        json["type"] = "pathlines";
        set(json, "start_time", lines.times->start);
        set(json, "end_time", lines.times->end);
        json["interpolation"] = lines.times->is_linear ? "linear" : "cubic";
    }
}

void add_arrows(SceneJson& json, const SceneArrows& arrows) {
    json["vectors"] = arrows.vectors;
    if (!arrows.on.empty()) {
        json["on"] = arrows.on;
    }
    set(json, "spacing", arrows.spacing);
    set(json, "scale", arrows.scale);
}

SceneJson geometry_json(const SurfaceGeometry& geometry, const std::string& scene) {
    SceneJson json;
    std::visit(Overloaded{[&](const CutPlane& plane) {
                              json["type"] = "plane";
                              json["plane"] = plane.plane;
                          },
                          [&](const BoundaryFaces& boundary) {
                              json["type"] = "boundary";
                              add_groups(json, boundary);
                          },
                          // What a file can say to the same effect.
                          [&](const FlatElements&) { json["type"] = "elements"; },
                          [&](const ElementFaces& elements) {
                              json["type"] = "elements";
                              add_selection(json, elements.selection);
                          },
                          [&](const WireFrame& frame) {
                              json["type"] = "wireframe";
                              add_wireframe(json, frame);
                          },
                          [&](const CutShape& shape) { json = shape_json(shape, scene); },
                          [&](const Isosurfaces& isosurfaces) {
                              json["type"] = "isosurface";
                              add_isosurfaces(json, isosurfaces);
                          }},
               geometry);
    return json;
}

/** The colour if there is only one, whatever the value: as the reader makes such maps. */
std::optional<Rgb> only_color(const std::optional<SceneColorMap>& map) {
    if (!map || !map->name.empty() || !map->file.empty() || map->points.size() != 1 || map->points[0].position != 0 ||
        map->space != ColorSpace::rgb || map->range != std::array<double, 2>{0, 1}) {
        return std::nullopt;
    }
    const Rgb color = map->points[0].rgb;
    return map->below == color && map->above == color && map->nan == color ? std::optional(color) : std::nullopt;
}

} // namespace

SceneJson surface_json(const SceneSurface& surface, const std::string& scene) {
    SceneJson json = geometry_json(surface.geometry, scene);
    const SurfaceTraits traits = traits_of(surface.geometry);
    const bool is_wireframe = traits.wires != nullptr, is_isosurface = traits.isosurfaces != nullptr;
    if (surface.streamlines) {
        add_streamlines(json, *surface.streamlines);
    }
    if (surface.arrows) {
        add_arrows(json, *surface.arrows);
    }
    if (!surface.name.empty()) {
        json["name"] = surface.name;
    }
    if (surface.field) {
        json["field"] = *surface.field;
    }
    if (surface.color_field) {
        json["color_field"] = *surface.color_field;
    }
    const std::optional<Rgb> color = only_color(surface.color_map);
    if (color && (is_wireframe || surface.streamlines || surface.arrows || (is_isosurface && !surface.color_field))) {
        json["color"] = *color;
    } else if (surface.color_map) {
        json["color_map"] = color_map_json(*surface.color_map, scene);
    }
    if (surface.contours) {
        json["contours"] = contours_json(*surface.contours);
    }
    if (surface.mesh_lines) {
        json["mesh_lines"] = line_style_json(*surface.mesh_lines);
    }
    if (surface.lic) {
        json["lic"] = lic_json(*surface.lic);
    }
    if (!surface.clip.empty()) {
        json["clip"] = surface.clip;
    }
    if (surface.opacity != 1) {
        json["opacity"] = surface.opacity;
    }
    if (surface.outside) {
        json["outside"] = *surface.outside;
    }
    // Light falls on all but wires if nothing is said.
    if (surface.is_lit == is_wireframe) {
        json["lighting"] = surface.is_lit;
    }
    if (!surface.is_shown) {
        json["visible"] = false;
    }
    return json;
}

} // namespace elvis
