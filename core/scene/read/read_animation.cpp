#include <core/scene/read/read_parts.hpp>

namespace elvis {

namespace {

TimeStepRange read_time_steps(const JsonObject& object) {
    const auto& value = object.raw("time_steps");
    if (value.is_string()) {
        const std::optional<TimeStepRange> range = parse_time_steps(value.get<std::string>());
        if (!range) {
            object.fail("time_steps",
                        "is " + value.dump() + R"(, where "all", "FIRST:LAST" or "FIRST:LAST:STRIDE" is expected)");
        }
        return *range;
    }
    object.fail("time_steps", "must be a text");
}

Turntable read_turntable(const JsonObject& object) {
    Turntable turntable;
    turntable.n_frames = object.integer("frames");
    if (object.has("axis")) {
        turntable.axis = fixed<3>(object.numbers("axis"));
        if (*turntable.axis == Vector3{}) {
            object.fail("axis", "has length zero");
        }
    }
    if (object.has("degrees")) {
        turntable.degrees = object.number("degrees");
    }
    return turntable;
}

KeyFrame read_key_frame(const JsonObject& object) {
    KeyFrame key;
    key.frame = object.integer("frame");
    if (object.has("eye")) {
        key.eye = fixed<3>(object.numbers("eye"));
    }
    if (object.has("look_at")) {
        key.look_at = fixed<3>(object.numbers("look_at"));
    }
    if (object.has("up")) {
        key.up = fixed<3>(object.numbers("up"));
    }
    if (object.has("field_of_view")) {
        key.field_of_view = object.number("field_of_view");
    }
    if (object.has("height")) {
        key.height = object.number("height");
    }
    return key;
}

} // namespace

SceneAnimation read_animation(const JsonObject& object) {
    SceneAnimation animation;
    if (object.has("time_steps")) {
        animation.time_steps = read_time_steps(object);
    }
    if (object.has("phases")) {
        if (animation.time_steps) {
            object.fail("phases", "and 'time_steps' are two times of one field");
        }
        animation.n_phases = object.integer("phases");
    }
    if (object.has("turntable")) {
        animation.turntable = read_turntable(object.object("turntable"));
    }
    if (object.has("key_frames")) {
        if (animation.turntable) {
            object.fail("key_frames", "and 'turntable' are two paths of one camera");
        }
        for (const JsonObject& key : object.objects("key_frames")) {
            animation.key_frames.push_back(read_key_frame(key));
        }
        bool is_ascending = animation.key_frames.size() >= 2 && animation.key_frames[0].frame == 0;
        for (std::size_t i = 1; i < animation.key_frames.size(); ++i) {
            is_ascending = is_ascending && animation.key_frames[i].frame > animation.key_frames[i - 1].frame;
        }
        if (!is_ascending) {
            object.fail("key_frames", "must be at least two, with 'frame' ascending from 0");
        }
    }
    if (object.has("frames_a_second")) {
        animation.frames_a_second = object.number("frames_a_second");
    }
    return animation;
}

} // namespace elvis
