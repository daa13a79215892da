#include <core/scene/scene_annotation.hpp>

#include <core/expression/expression.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <algorithm>
#include <cmath>
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
           a.is_logarithmic == b.is_logarithmic && is_same(a.below, b.below) && is_same(a.above, b.above) &&
           is_same(a.nan, b.nan);
}

ColorTable table_of(const TransferFunction& transfer) {
    ColorTable table;
    for (const TransferFunction::ColorPoint& point : transfer.color) {
        table.points.push_back({point.value, point.rgb});
    }
    const auto opaque = [](const std::array<double, 3>& rgb) { return Color{rgb[0], rgb[1], rgb[2], 1}; };
    table.below = opaque(transfer.color.front().rgb);
    table.above = opaque(transfer.color.back().rgb);
    return table;
}

/** Whether no one could tell the bars of two tables of the same map from each other, but for the colours of special values. */
bool look_same(const ColorTable& a, const ColorTable& b) {
    if (a.is_logarithmic != b.is_logarithmic || a.points.front().value != b.points.front().value ||
        a.points.back().value != b.points.back().value) {
        return false;
    }
    constexpr double visible = 1e-3;
    const auto lies_on = [](const ColorTable& points, const ColorTable& table) {
        return std::all_of(points.points.begin() + 1, points.points.end() - 1, [&](const ColorTable::Point& point) {
            const Color color = table_color(table, point.value);
            return std::abs(color[0] - point.rgb[0]) <= visible && std::abs(color[1] - point.rgb[1]) <= visible &&
                   std::abs(color[2] - point.rgb[2]) <= visible;
        });
    };
    return lies_on(a, b) && lies_on(b, a);
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
    const auto add = [&](const FieldChoice& field, const std::string& name, const ColorTable& colors) {
        fields.push_back(field);
        // The unit of an expression is the user's affair.
        const std::string unit = field.expression ? std::string{} : volume.fields()[field.field].unit;
        const bool is_named = field.expression && !name.empty();
        result.color_bars.push_back({colors, is_named ? name : field_label(volume, field), unit});
    };
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
            add(surface.field, surface.field_label, surface.colors);
        }
        const SpecialValues& special = frame.special_values[index];
        result.color_bars[bar].has_below |= special.below;
        result.color_bars[bar].has_above |= special.above;
        result.color_bars[bar].has_nan |= special.nan;
    }
    if (request.volume && request.volume->transfer.color.size() >= 2) {
        const ColorTable colors = request.volume->legend ? *request.volume->legend : table_of(request.volume->transfer);
        bool is_shown = false;
        for (std::size_t bar = 0; bar < fields.size(); ++bar) {
            is_shown = is_shown || (fields[bar] == request.volume->field && look_same(result.color_bars[bar].colors, colors));
        }
        if (!is_shown && colors.points.front().value < colors.points.back().value) {
            add(request.volume->field, request.volume->field_label, colors);
        }
    }
    return result;
}

} // namespace elvis
