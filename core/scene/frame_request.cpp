#include <core/scene/frame_request.hpp>

#include <core/annotation/annotation.hpp>
#include <core/annotation/drawing.hpp>
#include <core/annotation/ticks.hpp>
#include <core/base/bounds.hpp>
#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/expression/expression.hpp>
#include <core/scene/color/color_map.hpp>
#include <core/scene/color/transfer.hpp>
#include <core/scene/default_surfaces.hpp>
#include <core/scene/lic.hpp>
#include <core/scene/line_width.hpp>
#include <core/scene/resolve.hpp>
#include <core/scene/surface_distance.hpp>
#include <core/scene/threshold.hpp>
#include <core/volume/outline.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

namespace elvis {

namespace {

/** What the camera looks at from the front, if nothing else is said. */
std::vector<CutPlane> planes_looked_at(const std::vector<SceneSurface>& surfaces, const RuntimeVolume& volume,
                                       const PictureRanges& ranges) {
    if (volume.dimension() == 2) {
        return plane_of_flat(ranges.bounds());
    }
    std::vector<CutPlane> planes;
    for (const SceneSurface& surface : surfaces) {
        if (const CutPlane* const plane = traits_of(surface.geometry).plane) {
            planes.push_back(*plane);
        }
    }
    return planes.size() == surfaces.size() ? planes : std::vector<CutPlane>{};
}

/** Black or white, whichever stands out more. */
std::array<double, 3> ink_on(const Color& color) {
    const double level = brightness(color) > 0.5 ? 0 : 1;
    return {level, level, level};
}

LineStyle line_style(const SceneLineStyle& style) { return {style.width, style.color, style.undecided_color}; }

/** Some ten inside the range: at its ends are extrema, of which lines would be specks. */
std::vector<double> round_values(const std::array<double, 2>& range, bool is_logarithmic) {
    constexpr int most = 12;
    const Ticks ticks = is_logarithmic ? logarithmic_ticks(range[0], range[1], most) : round_ticks(range[0], range[1], most);
    const double near = 1e-6 * (range[1] - range[0]);
    std::vector<double> values;
    for (const Tick& tick : ticks.ticks) {
        if (tick.value > range[0] + near && tick.value < range[1] - near) {
            values.push_back(tick.value);
        }
    }
    return values;
}

std::optional<Contours> contours_of(const std::optional<SceneContours>& scene, const SceneColorMap& map,
                                    const ColorTable& colors, const std::array<double, 2>& color_range,
                                    const std::array<std::uint32_t, 2>& size) {
    if (!scene) {
        return {};
    }
    Contours contours{scene->values, line_style(scene->style)};
    const std::array<double, 2> range = scene->range.value_or(color_range);
    const ColorScale scale(range, map.is_logarithmic);
    for (std::uint32_t i = 1; i <= scene->count; ++i) {
        contours.values.push_back(scale.value(i / (scene->count + 1.0)));
    }
    if (scene->is_round) {
        contours.values = round_values(range, map.is_logarithmic);
    }
    if (contours.values.empty()) {
        return {};
    }
    if (scene->style.width == width_by_size) {
        contours.style.width = default_line_width(size);
    }
    if (!scene->style.color && !scene->has_map_color) {
        for (const double value : contours.values) {
            contours.inks.push_back(ink_on(table_color(colors, value)));
        }
    }
    return contours;
}

std::optional<MeshLines> mesh_lines_of(const std::optional<SceneLineStyle>& scene) {
    if (!scene) {
        return {};
    }
    MeshLines lines{line_style(*scene)};
    // Dark, but not to be taken for contours.
    lines.style.color = scene->color.value_or(Rgb{0.3, 0.3, 0.3});
    return lines;
}

/** The field of that text, in which distances are to surfaces of the scene; and what people know it by. */
FieldChoice choose_field(const Scene& scene, const RuntimeVolume& volume, const std::optional<std::string>& text,
                         std::string& label) {
    if (!text) {
        return choose_field(volume, text);
    }
    label = *text;
    return choose_field(volume, with_distances(*text, scene.surfaces));
}

/** What a surface's geometry takes from its field and volume. */
struct GeometryCompletion {
    const Scene& scene;
    const SceneSurface& own;
    const RuntimeVolume& volume;
    Surface& surface;

    void operator()(CutPlane&) const {}
    void operator()(CutShape&) const {}
    void operator()(BoundaryFaces&) const {}
    void operator()(FlatElements&) const {}
    /** Conditions on values and orders are about the field drawn. */
    void operator()(ElementFaces& elements) const {
        ElementSelection& selection = elements.selection;
        const FieldChoice& field = surface.field;
        const bool has_condition = selection.value_range || selection.orders;
        if (has_condition && field.expression) {
            throw Error(scene.volume, "elements can be chosen by the values and order of a field, not of an expression");
        }
        if (has_condition) {
            volume.need_own(field.field);
        }
        selection.field = field.field;
        selection.component = field.component;
        selection.time_step = selection.value_range ? scene.time_step : 0;
        selection.is_two_sided = field.expression || volume.fields()[field.field].continuity != ELVIS_CONTINUITY_CONTINUOUS;
    }
    void operator()(WireFrame& wires) const {
        if (volume.dimension() == 2 && std::holds_alternative<BoundaryFaces>(wires.faces)) {
            wires.faces = FlatElements{};
        }
        std::visit(*this, wires.faces);
    }
    void operator()(Isosurfaces& isosurfaces) const {
        isosurfaces.field = surface.field;
        if (own.color_field) {
            surface.field = choose_field(scene, volume, own.color_field, surface.field_label);
        }
    }
};

std::string text_of(double number) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", number);
    return text.data();
}

/** A range that is rounding and nothing else becomes wide enough for rounding not to be seen, and a remark. */
std::array<double, 2> beyond_rounding(const FieldRange& all, double rounding, const std::string& label,
                                      std::vector<std::string>& remarks) {
    // A thirtieth of the colours is hardly seen.
    constexpr double roundings = 32;
    if (!(rounding > 0) || !std::isfinite(rounding) || all.upper - all.lower > 2 * rounding) {
        return {all.lower, all.upper};
    }
    const double middle = 0.5 * (all.lower + all.upper);
    const std::array<double, 2> wider = {middle - roundings * rounding, middle + roundings * rounding};
    const std::string remark = (label.empty() ? std::string("the field") : label) +
                               " is constant but for rounding: " + text_of(middle) + " within " + text_of(rounding) +
                               "; its colours span [" + text_of(wider[0]) + ", " + text_of(wider[1]) +
                               "] (--range sets others, --precision float64 shows finer differences)";
    if (std::ranges::find(remarks, remark) == remarks.end()) {
        remarks.push_back(remark);
    }
    return wider;
}

std::array<double, 2> range_of(const SceneColorMap& map, const FieldChoice& field, const std::string& label, const Scene& scene,
                               PictureRanges& ranges, std::vector<std::string>& remarks) {
    if (map.range) {
        return *map.range;
    }
    const std::vector<std::uint32_t> steps = scene.range_steps.empty() ? std::vector{scene.time_step} : scene.range_steps;
    FieldRange all = ranges.extrema(field, steps.front()).range();
    for (const std::uint32_t step : steps) {
        const FieldRange range = ranges.extrema(field, step).range();
        all = {std::min(all.lower, range.lower), std::max(all.upper, range.upper)};
    }
    if (map.is_logarithmic || !(all.lower <= all.upper)) {
        return {all.lower, all.upper};
    }
    return beyond_rounding(all, ranges.value_rounding(field, steps.front()), label, remarks);
}

VolumeRendering make_volume_rendering(const SceneVolumeRendering& own, const Scene& scene, const RuntimeVolume& volume,
                                      PictureRanges& ranges, std::vector<std::string>& remarks) {
    if (volume.dimension() == 2) {
        throw Error(scene.volume, "is two-dimensional: it has nothing inside for 'volume_rendering' to show");
    }
    VolumeRendering rendering;
    rendering.field = choose_field(scene, volume, own.field ? own.field : scene.field, rendering.field_label);
    const std::array<double, 6> bounds = ranges.bounds();
    const double diagonal = diagonal_of(bounds);
    const SceneColorMap& map = own.color_map ? *own.color_map : scene.color_map;
    std::array<double, 2> range{};
    if (own.is_colored_by_map()) {
        range = range_of(map, rendering.field, rendering.field_label, scene, ranges, remarks);
    }
    rendering.transfer = make_transfer_function(own, map, range, diagonal);
    if (own.is_colored_by_map() && map.is_logarithmic) {
        rendering.legend = make_color_table(map, range);
    }
    rendering.integrator = own.integrator;
    rendering.step = own.step.value_or(diagonal / 256);
    rendering.tolerance = own.tolerance;
    rendering.skips_by_range = own.skips_by_range;
    return rendering;
}

Surface make_surface(const SceneSurface& own, const Scene& scene, const RuntimeVolume& volume, PictureRanges& ranges,
                     std::vector<std::string>& remarks) {
    Surface surface;
    surface.geometry = own.geometry;
    surface.field = choose_field(scene, volume, own.field ? own.field : scene.field, surface.field_label);
    std::visit(GeometryCompletion{scene, own, volume, surface}, surface.geometry);
    const SceneColorMap& map = own.color_map ? *own.color_map : scene.color_map;
    const std::array<double, 2> range = range_of(map, surface.field, surface.field_label, scene, ranges, remarks);
    surface.colors = make_color_table(map, range);
    const SurfaceTraits traits = traits_of(surface.geometry);
    if ((map.is_logarithmic && !surface.field.expression) || traits.has_own_values) {
        // Small values keep their digits: nothing is subtracted from them; nor from values that do not come from the device.
        surface.field.offset = 0;
    }
    if (traits.wires == nullptr && !traits.has_own_values) {
        surface.contours = contours_of(own.contours ? own.contours : scene.contours, map, surface.colors, range, scene.size);
        surface.mesh_lines = mesh_lines_of(own.mesh_lines ? own.mesh_lines : scene.mesh_lines);
    }
    if (traits.wires == nullptr && !traits.has_own_values && !own.streamlines && (own.lic || scene.lic)) {
        surface.lic = lic_of(own.lic ? *own.lic : *scene.lic, scene, volume);
    }
    surface.subdivisions = scene.subdivisions;
    surface.clip = own.clip;
    surface.opacity = own.opacity;
    surface.outside = own.outside;
    surface.is_lit = own.is_lit;
    return surface;
}

} // namespace

FieldChoice choose_field(const RuntimeVolume& volume, const std::optional<std::string>& text) {
    if (volume.fields().empty()) {
        throw Error(volume.path(), "has no field to draw");
    }
    const std::vector<FieldInfo>& fields = volume.fields();
    // A name may be no word of the language of expressions.
    const auto named =
        text ? std::find_if(fields.begin(), fields.end(), [&](const FieldInfo& info) { return info.name == *text; })
             : fields.begin();
    FieldChoice choice;
    if (named != fields.end()) {
        choice.field = static_cast<std::uint32_t>(named - fields.begin());
        choice.component = named->n_components > 1 ? -1 : 0;
        return choice;
    }
    const auto expression = std::make_shared<const Expression>(*text, fields, volume.dimension());
    if (expression->plain()) {
        choice.field = expression->plain()->field;
        choice.component = expression->plain()->component;
    } else {
        choice.expression = expression;
    }
    return choice;
}

namespace {

/** Edges of another shape of the volume, which stand beside what is shown. */
bool is_undeformed(const SceneSurface& surface) {
    const WireFrame* const wires = traits_of(surface.geometry).wires;
    return wires != nullptr && wires->is_undeformed;
}

/** Where a volume is that fills the picture; with where it was, if that is shown, too. */
VolumeExtent extent_of(const RuntimeVolume& volume, const std::vector<SceneSurface>& surfaces, PictureRanges& ranges) {
    VolumeExtent extent{ranges.bounds(), ranges.outline()};
    const bool shows_undeformed = std::ranges::any_of(surfaces, is_undeformed);
    if (const RuntimeVolume* const before = shows_undeformed ? volume.undeformed() : nullptr) {
        std::vector<double> boxes(6 * before->n_elements());
        before->bounds(0, before->n_elements(), boxes);
        for (std::size_t at = 0; at < boxes.size(); ++at) {
            double& bound = extent.bounds[at % 6];
            bound = at % 6 < 3 ? std::min(bound, boxes[at]) : std::max(bound, boxes[at]);
        }
        std::ranges::copy(outline_points(*before, boxes), std::back_inserter(extent.outline));
    }
    return extent;
}

} // namespace

std::vector<SceneSurface> drawn_surfaces(const Scene& scene, const RuntimeVolume& volume, PictureRanges& ranges) {
    std::vector<SceneSurface> drawn;
    const bool says_none = std::ranges::all_of(scene.surfaces, is_undeformed);
    if (says_none && (volume.dimension() == 2 || !scene.volume_rendering)) {
        if (scene.threshold && volume.dimension() == 3 && has_faces(volume, ranges)) {
            drawn = {SceneSurface{BoundaryFaces{}}};
        } else {
            std::string label;
            drawn = default_surfaces(scene.camera, volume, ranges, choose_field(scene, volume, scene.field, label),
                                     scene.time_step);
        }
    }
    std::ranges::copy_if(scene.surfaces, std::back_inserter(drawn), &SceneSurface::is_shown);
    return drawn;
}

SurfaceGeometry complete_geometry(const SceneSurface& own, const Scene& scene, const RuntimeVolume& volume) {
    Surface surface;
    surface.geometry = own.geometry;
    surface.field = choose_field(scene, volume, own.field ? own.field : scene.field, surface.field_label);
    std::visit(GeometryCompletion{scene, own, volume, surface}, surface.geometry);
    return surface.geometry;
}

FrameRequest make_frame_request(const Scene& scene, const RuntimeVolume& volume, PictureRanges& ranges) {
    if (scene.time_step >= volume.times().size()) {
        throw Error(scene.volume, "has " + counted(volume.times().size(), "time step") + ", counted from 0; there is no step " +
                                      std::to_string(scene.time_step));
    }
    FrameRequest request;
    request.width = scene.size[0];
    request.height = scene.size[1];
    request.background = scene.background;
    request.lighting = scene.lighting;
    request.time_step = scene.time_step;
    const std::vector<SceneSurface> surfaces = drawn_surfaces(scene, volume, ranges);
    const VolumeExtent extent =
        is_placed(scene.camera) ? VolumeExtent{ranges.bounds(), {}} : extent_of(volume, surfaces, ranges);
    request.camera = resolve_camera(scene, extent, planes_looked_at(surfaces, volume, ranges));
    for (const SceneSurface& surface : surfaces) {
        request.surfaces.push_back(make_surface(surface, scene, volume, ranges, request.remarks));
    }
    if (scene.volume_rendering && scene.volume_rendering->is_shown) {
        request.volume = make_volume_rendering(*scene.volume_rendering, scene, volume, ranges, request.remarks);
    }
    apply_threshold(scene, volume, request);
    return request;
}

} // namespace elvis
