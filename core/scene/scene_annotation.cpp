#include <core/scene/scene_annotation.hpp>

#include <core/expression/expression.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace elvis {

namespace {

bool is_same(const Color& a, const Color& b) { return a == b; }

bool is_same(const ColorTable& a, const ColorTable& b) {
    const auto is_equal = [](const ColorTable::Point& p, const ColorTable::Point& q) {
        return p.value == q.value && p.rgb == q.rgb;
    };
    return std::equal(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(), is_equal) &&
           is_same(a.below, b.below) && is_same(a.above, b.above) && is_same(a.nan, b.nan);
}

std::string default_title(const RuntimeVolume& volume, std::uint32_t time_step) {
    std::string title = std::filesystem::path(volume.path()).stem().string();
    if (volume.times().size() > 1) {
        char time[40];
        std::snprintf(time, sizeof time, ", t = %.6g", volume.times()[time_step]);
        title += time;
    }
    return title;
}

} // namespace

std::string field_label(const RuntimeVolume& volume, const FieldChoice& field) {
    if (field.expression) {
        return field.expression->text();
    }
    const FieldInfo& info = volume.fields()[field.field];
    if (info.n_components == 1) {
        return info.name;
    }
    std::string label = info.name;
    return field.component < 0 ? label.insert(0, 1, '|').append(1, '|')
                               : label.append(1, '[').append(std::to_string(field.component)).append(1, ']');
}

AnnotationRequest make_annotation_request(const SceneAnnotation& annotation, const FrameRequest& request, const Frame& frame,
                                          const RuntimeVolume& volume) {
    AnnotationRequest result = annotation.style;
    result.title = annotation.title ? *annotation.title : default_title(volume, request.time_step);
    if (annotation.has_axes) {
        result.axes = request.camera;
    }
    if (!annotation.has_color_bars) {
        return result;
    }
    std::vector<FieldChoice> fields;
    for (std::size_t index = 0; index < request.surfaces.size(); ++index) {
        const Surface& surface = request.surfaces[index];
        // One colour, as of wires, tells nothing.
        if (surface.colors.points.size() < 2) {
            continue;
        }
        std::size_t bar = 0;
        while (bar < fields.size() &&
               !(fields[bar] == surface.field && is_same(result.color_bars[bar].colors, surface.colors))) {
            ++bar;
        }
        if (bar == fields.size()) {
            fields.push_back(surface.field);
            // The unit of an expression is the user's affair.
            const std::string unit = surface.field.expression ? std::string{} : volume.fields()[surface.field.field].unit;
            const bool is_named = surface.field.expression && !surface.field_label.empty();
            const std::string label = is_named ? surface.field_label : field_label(volume, surface.field);
            result.color_bars.push_back({surface.colors, label, unit});
        }
        const SpecialValues& special = frame.special_values[index];
        result.color_bars[bar].has_below |= special.below;
        result.color_bars[bar].has_above |= special.above;
        result.color_bars[bar].has_nan |= special.nan;
    }
    return result;
}

} // namespace elvis
