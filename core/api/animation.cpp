#include "drawing.hpp"

#include <core/base/counted.hpp>

namespace elvis::library {

namespace {

const AnimationFrame& frame_of(const Animation& animation, std::uint32_t frame) {
    const std::vector<AnimationFrame>& frames = animation.pictures.frames();
    if (frame >= frames.size()) {
        throw InvalidArgument("frame", "the animation has " + counted(frames.size(), "frame") + ", counted from 0");
    }
    return frames[frame];
}

} // namespace

} // namespace elvis::library

using namespace elvis;
using namespace elvis::library;

elvis_result elvis_animation_create(elvis_data* data, const elvis_scene* scene, elvis_animation** animation) {
    return call(data, [&] {
        need(animation, "animation");
        *animation = nullptr;
        need(scene, "scene");
        if (!scene->state.scene.animation) {
            throw InvalidArgument("scene", "has no animation");
        }
        need_one_volume(scene->state.scene, "an animation");
        const std::shared_ptr<Data> state = shown_data(data->state, scene->state.scene, nullptr);
        const DataTask running(*state, nullptr);
        Scene shown = scene_for(*state, scene->state.scene);
        const Precision precision = precision_of(shown);
        PictureRanges& ranges =
            shown.memory ? state->on_demand(precision, *shown.memory).ranges() : state->renderer(precision).ranges();
        *animation = new elvis_animation{{data->state, precision, AnimationPictures(std::move(shown), state->volume, ranges)}};
    });
}

void elvis_animation_release(elvis_animation* animation) { delete animation; }

elvis_result elvis_animation_get_info(elvis_animation* animation, elvis_animation_info* info) {
    return call(animation, [&] {
        elvis_animation_info ours{};
        ours.n_frames = static_cast<std::uint32_t>(animation->state.pictures.frames().size());
        ours.frames_a_second = animation->state.pictures.frames_a_second();
        give(ours, info, "info");
    });
}

elvis_result elvis_animation_get_time_step(elvis_animation* animation, uint32_t frame, uint32_t* time_step) {
    return call(animation, [&] {
        need(time_step, "time_step");
        *time_step = frame_of(animation->state, frame).time_step;
    });
}

elvis_result elvis_animation_render(elvis_animation* animation, uint32_t frame, const elvis_render_options* options,
                                    const elvis_task* task, elvis_picture** picture) {
    return call(animation, [&] {
        need(picture, "picture");
        *picture = nullptr;
        const elvis_render_options known = known_or_zero(options);
        if (known.width != 0 || known.height != 0) {
            throw InvalidArgument("options", "pictures of an animation have the scene's size");
        }
        Animation& state = animation->state;
        frame_of(state, frame);
        Scene scene = state.pictures.scene_of(frame);
        const std::shared_ptr<Data> shown = shown_data(state.data, scene, task);
        const DataTask running(*shown, task);
        if (scene.memory) {
            VolumeOnDemand& drawing = shown->on_demand(state.precision, *scene.memory);
            const StillOptions how = still_options(*shown, state.precision, known);
            const auto draw_it = [&](const Scene& still, FrameRequest request) {
                return drawing.draw_request(still, std::move(request), how);
            };
            StillPicture drawn = state.pictures.draw(frame, scene, shown->volume, drawing.ranges(), draw_it);
            *picture = new_picture(shown, state.precision, std::move(drawn), drawing.work());
            return;
        }
        provide_glyphs(*shown, scene);
        Renderer& renderer = shown->renderer(state.precision);
        *picture = new_picture(shown, state.precision,
                               state.pictures.draw(frame, scene, shown->volume, renderer,
                                                   still_options(*shown, state.precision, known), shown->control.get()));
    });
}

elvis_result elvis_animation_get_remarks(elvis_animation* animation, char** text) {
    return call(animation, [&] {
        need(text, "text");
        Animation& state = animation->state;
        const std::shared_ptr<Data> shown = shown_data(state.data, state.pictures.scene_of(0), nullptr);
        const DataTask running(*shown, nullptr);
        const std::optional<MemoryBudget> memory = state.pictures.scene_of(0).memory;
        PictureRanges& ranges =
            memory ? shown->on_demand(state.precision, *memory).rough_ranges() : shown->renderer(state.precision).ranges();
        const nlohmann::json list = state.pictures.missed(ranges);
        *text = text_for_caller(list.dump());
    });
}
