#include <core/scene/write/write_parts.hpp>

namespace elvis {

namespace {

std::string text_of(const TimeStepRange& range) {
    if (!range.last) {
        return "all";
    }
    const std::string text = std::to_string(range.first) + ":" + std::to_string(*range.last);
    return range.stride == 1 ? text : text + ":" + std::to_string(range.stride);
}

SceneJson turntable_json(const Turntable& turntable) {
    SceneJson json;
    json["frames"] = turntable.n_frames;
    set(json, "axis", turntable.axis);
    json["degrees"] = turntable.degrees;
    return json;
}

SceneJson key_frame_json(const KeyFrame& key) {
    SceneJson json;
    json["frame"] = key.frame;
    set(json, "eye", key.eye);
    set(json, "look_at", key.look_at);
    set(json, "up", key.up);
    set(json, "field_of_view", key.field_of_view);
    set(json, "height", key.height);
    return json;
}

} // namespace

SceneJson animation_json(const SceneAnimation& animation) {
    SceneJson json;
    if (animation.time_steps) {
        json["time_steps"] = text_of(*animation.time_steps);
    }
    if (animation.n_phases > 0) {
        json["phases"] = animation.n_phases;
    }
    if (animation.turntable) {
        json["turntable"] = turntable_json(*animation.turntable);
    }
    for (const KeyFrame& key : animation.key_frames) {
        json["key_frames"].push_back(key_frame_json(key));
    }
    json["frames_a_second"] = animation.frames_a_second;
    return json;
}

} // namespace elvis
