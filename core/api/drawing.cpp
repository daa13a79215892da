#include "drawing.hpp"

#include <core/annotation/font.hpp>

#include <algorithm>

namespace elvis::library {

Scene scene_for(const Data& data, Scene scene) {
    scene.volume = data.volume.path();
    if (scene.annotation) {
        const Font font(scene.annotation->style.font);
    }
    return scene;
}

std::shared_ptr<Data> shown_data(const std::shared_ptr<Data>& data, const Scene& scene, const elvis_task* task) {
    if (!scene.warp) {
        return data;
    }
    const DataTask running(*data, task);
    return data->warped(*scene.warp, scene.time_step);
}

void provide_glyphs(Data& data, Scene& scene) {
    const auto is_line = [](const SceneSurface& surface) { return surface.streamlines.has_value(); };
    if (std::ranges::any_of(scene.surfaces, is_line)) {
        data.streamlines.provide(scene, data.volume, data.bounds(), *data.control);
    }
    const auto is_arrow = [](const SceneSurface& surface) { return surface.arrows.has_value(); };
    if (std::ranges::any_of(scene.surfaces, is_arrow)) {
        data.arrow_sets.provide(scene, data.volume, data.bounds(), *data.control);
    }
}

StillOptions still_options(Data& data, Precision precision, const elvis_render_options& options) {
    StillOptions how;
    how.others = data.other_renderers(precision);
    how.with_buffers = (options.flags & ELVIS_RENDER_COLOR_ONLY) == 0;
    how.sharing.depths = (options.flags & ELVIS_RENDER_SHARE_DEPTHS) != 0;
    how.sharing.rows = (options.flags & ELVIS_RENDER_ALL_ROWS) == 0;
    return how;
}

elvis_picture* new_picture(const std::shared_ptr<Data>& data, Precision precision,
                           std::variant<StillPicture, ScreenPicture> drawn) {
    auto picture = std::make_unique<elvis_picture>();
    picture->state = {data, precision, std::move(drawn), {}, {}};
    picture->state.stats = PictureStats(data->context->device(), precision, picture->state.frame(), data->renderer(precision));
    return picture.release();
}

elvis_picture* new_picture(const std::shared_ptr<Data>& data, Precision precision, StillPicture still, const DemandWork& work) {
    auto picture = std::make_unique<elvis_picture>();
    picture->state = {data, precision, std::move(still), {}, work};
    picture->state.stats = PictureStats(data->context->device(), precision, picture->state.frame());
    return picture.release();
}

} // namespace elvis::library
