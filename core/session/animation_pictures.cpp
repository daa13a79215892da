#include <core/session/animation_pictures.hpp>

#include <core/scene/frame_request.hpp>

#include <utility>

namespace elvis {

std::vector<std::uint32_t> steps_of_animation(const Scene& scene, const RuntimeVolume& volume) {
    if (!scene.animation || !scene.animation->time_steps) {
        return {};
    }
    return steps_of(*scene.animation->time_steps, volume.times().size(), scene.volume);
}

AnimationPictures::AnimationPictures(Scene scene, const RuntimeVolume& volume, PictureRanges& ranges)
    : m_scene(std::move(scene)) {
    m_scene.range_steps = steps_of_animation(m_scene, volume);
    Scene first = m_scene;
    first.time_step = m_scene.range_steps.empty() ? m_scene.time_step : m_scene.range_steps.front();
    const Camera camera = make_frame_request(first, volume, ranges).camera;
    m_frames = animation_frames(*m_scene.animation, m_scene.range_steps, m_scene.time_step, camera);
}

Scene AnimationPictures::scene_of(std::size_t frame) const {
    const AnimationFrame& wanted = m_frames.at(frame);
    Scene scene = m_scene;
    scene.time_step = wanted.time_step;
    if (scene.warp && wanted.phase) {
        scene.warp->phase = *wanted.phase;
    }
    return scene;
}

const FrameRequest& AnimationPictures::request_of(const Scene& scene, Moment moment, const RuntimeVolume& volume,
                                                  PictureRanges& ranges) {
    auto found = m_requests.find(moment);
    if (found == m_requests.end()) {
        found = m_requests.try_emplace(moment, make_frame_request(scene, volume, ranges)).first;
    }
    return found->second;
}

StillPicture AnimationPictures::draw(std::size_t frame, const Scene& shown, const RuntimeVolume& volume, Renderer& renderer,
                                     const StillOptions& options, const TaskControl* control) {
    return draw(frame, shown, volume, renderer.ranges(), [&](const Scene& scene, FrameRequest request) {
        return draw_request(scene, std::move(request), volume, renderer, options, control);
    });
}

StillPicture AnimationPictures::draw(std::size_t frame, const Scene& shown, const RuntimeVolume& volume, PictureRanges& ranges,
                                     const DrawRequest& draw_it) {
    const AnimationFrame& wanted = m_frames.at(frame);
    const Moment moment = moment_of(wanted);
    FrameRequest request = request_of(shown, moment, volume, ranges);
    request.camera = wanted.camera;
    std::vector<FrameRemark> remarks = m_drawn.contains(moment) ? std::vector<FrameRemark>() : remarks_on(m_scene, request);
    StillPicture still = draw_it(m_scene, std::move(request));
    still.remarks.insert(still.remarks.begin(), remarks.begin(), remarks.end());
    m_drawn.insert(moment);
    m_missed.add(still.request, still.frame);
    return still;
}

std::vector<std::string> AnimationPictures::missed(PictureRanges& ranges) const {
    if (m_drawn.empty()) {
        return {};
    }
    return m_missed.remarks(m_scene, m_requests.at(*m_drawn.begin()), ranges);
}

} // namespace elvis
