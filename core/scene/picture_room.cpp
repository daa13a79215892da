#include <core/scene/picture_room.hpp>

#include <core/scene/scene.hpp>

#include <algorithm>
#include <set>

namespace elvis {

namespace {

/** One for each field and colour map: maps that surfaces have of their own are counted as different. */
std::size_t expected_bars(const Scene& scene) {
    std::set<std::string> fields;
    std::size_t n_own = 0;
    const auto add = [&](const std::optional<std::string>& field, const std::optional<SceneColorMap>& map) {
        if (!map) {
            fields.insert(field.value_or(scene.field.value_or("")));
        } else {
            // One colour, as of wires, has no bar.
            n_own += map->points.size() == 1 ? 0 : 1;
        }
    };
    for (const SceneSurface& surface : scene.surfaces) {
        if (surface.is_shown) {
            add(surface.color_field ? surface.color_field : surface.field, surface.color_map);
        }
    }
    if (scene.volume_rendering && scene.volume_rendering->is_shown) {
        add(scene.volume_rendering->field, scene.volume_rendering->color_map);
    }
    return std::max<std::size_t>(1, fields.size() + n_own);
}

} // namespace

PictureRoom room_for_volume(const Scene& scene) {
    PictureRoom room;
    room.width = scene.size[0];
    room.height = scene.size[1];
    if (!scene.annotation) {
        return room;
    }
    const AnnotationRequest& style = scene.annotation->style;
    const double side = std::min(room.width, room.height);
    const double em = std::max(style.least_text_pixels, style.text_size * side);
    if (scene.annotation->has_color_bars) {
        // Beside the bar: a tick, a number of six characters, the name upright, and what is between them.
        constexpr double beside = 6.5;
        const double bars = static_cast<double>(expected_bars(scene)) * (style.bar_width * side + beside * em);
        // A picture too narrow for its bars still shows the volume.
        constexpr double most = 0.4;
        (style.bars_at_left ? room.left : room.right) = std::min(bars, most * room.width);
    }
    if (!scene.annotation->title || !scene.annotation->title->empty()) {
        constexpr double most = 0.2;
        room.top = std::min((style.title_scale + 1) * em, most * room.height);
    }
    return room;
}

} // namespace elvis
