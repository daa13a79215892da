#include "drawing.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace elvis::library {

namespace {

/** With the options' size, which both must be given or neither. */
void resize(Scene& scene, const elvis_render_options& options) {
    if ((options.width == 0) != (options.height == 0)) {
        throw InvalidArgument("options", "width and height are given together");
    }
    if (options.width != 0) {
        constexpr std::uint32_t most = 32768; // As in the schema of scenes.
        if (options.width > most || options.height > most) {
            throw InvalidArgument("options", "a picture has at most 32768 columns and rows");
        }
        scene.size = {options.width, options.height};
    }
}

/** Depths of what hides the volume; null where nothing does. */
std::shared_ptr<const std::vector<double>> hidden_from(const Scene& scene, const elvis_render_options& options) {
    if (options.hidden_from == nullptr) {
        return nullptr;
    }
    if (!scene.volume_rendering || !scene.surfaces.empty() || scene.samples > 1) {
        throw InvalidArgument("options", "hidden_from is for scenes with volume rendering, without surfaces and samples");
    }
    const std::size_t n_pixels = std::size_t{scene.size[0]} * scene.size[1];
    auto depths = std::make_shared<std::vector<double>>(options.hidden_from, options.hidden_from + n_pixels);
    if (std::ranges::any_of(*depths, [](double depth) { return std::isnan(depth); })) {
        throw InvalidArgument("options", "hidden_from has a depth that is not a number");
    }
    return depths;
}

ScreenOptions screen_options(const elvis_screen_options& options) {
    constexpr std::uint32_t most_divisor = 256;
    ScreenOptions how;
    how.is_coarse = (options.flags & ELVIS_SCREEN_COARSE) != 0;
    how.has_no_lines = (options.flags & ELVIS_SCREEN_NO_LINES) != 0;
    how.divisor = std::max(1u, options.divisor);
    if (!how.is_coarse && (how.has_no_lines || how.divisor > 1)) {
        throw InvalidArgument("options", "pictures that are not coarse have all lines and pixels");
    }
    if (how.divisor > most_divisor) {
        throw InvalidArgument("options", "divisor is at most 256");
    }
    return how;
}

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_render(elvis_data* data, const elvis_scene* scene, const elvis_render_options* options,
                          const elvis_task* task, elvis_picture** picture) {
    return call(data, [&] {
        need(picture, "picture");
        *picture = nullptr;
        need(scene, "scene");
        const elvis_render_options known = known_or_zero(options);
        const bool has_budget = scene->state.scene.memory.has_value();
        if (!scene->state.scene.volumes.empty() && !has_budget) {
            Scene several = scene->state.scene;
            resize(several, known);
            *picture = draw_volumes(data->state, several, known, task);
            return;
        }
        const std::shared_ptr<Data> shown = shown_data(data->state, scene->state.scene, task);
        Data& state = *shown;
        Scene still = scene_for(state, scene->state.scene);
        still.animation.reset();
        resize(still, known);
        const DataTask running(state, task);
        const Precision precision = precision_of(still);
        VolumeOnDemand* const within_budget = has_budget ? &state.on_demand(precision, *still.memory) : nullptr;
        StillOptions how = still_options(state, precision, known);
        how.hidden_from = hidden_from(still, known);
        if (within_budget != nullptr) {
            StillPicture drawn = within_budget->draw(still, how);
            *picture = new_picture(shown, precision, std::move(drawn), within_budget->work());
            return;
        }
        provide_glyphs(state, still);
        *picture =
            new_picture(shown, precision, draw_still(still, state.volume, state.renderer(precision), how, state.control.get()));
    });
}

elvis_result elvis_render_for_screen(elvis_data* data, const elvis_scene* scene, const elvis_screen_options* options,
                                     const elvis_task* task, elvis_picture** picture) {
    return call(data, [&] {
        need(picture, "picture");
        *picture = nullptr;
        need(scene, "scene");
        const ScreenOptions how = screen_options(known_or_zero(options));
        if (!scene->state.scene.volumes.empty()) {
            *picture = draw_volumes_for_screen(data->state, scene->state.scene, how, task);
            return;
        }
        const std::shared_ptr<Data> shown = shown_data(data->state, scene->state.scene, task);
        Data& state = *shown;
        Scene said = scene_for(state, scene->state.scene);
        const DataTask running(state, task);
        provide_glyphs(state, said);
        const Precision precision = precision_of(said);
        *picture = new_picture(shown, precision,
                               draw_for_screen(said, state.volume, state.renderer(precision), how, state.control.get()));
    });
}

elvis_result elvis_data_prepare(elvis_data* data, const elvis_scene* scene, const elvis_task* task) {
    return call(data, [&] {
        need(scene, "scene");
        const std::shared_ptr<Data> shown = shown_data(data->state, scene->state.scene, task);
        const DataTask running(*shown, task);
        shown->renderer(precision_of(scene->state.scene));
    });
}
