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

AnimationPictures::AnimationPictures(Scene scene, const RuntimeVolume& volume, VolumeRanges& ranges)
    : m_scene(std::move(scene)), m_volume(volume) {
    m_scene.range_steps = steps_of_animation(m_scene, volume);
    const std::uint32_t first = m_scene.range_steps.empty() ? m_scene.time_step : m_scene.range_steps.front();
    m_frames = animation_frames(*m_scene.animation, m_scene.range_steps, m_scene.time_step, request_of(first, ranges).camera);
}

const FrameRequest& AnimationPictures::request_of(std::uint32_t time_step, VolumeRanges& ranges) {
    auto found = m_requests.find(time_step);
    if (found == m_requests.end()) {
        Scene scene = m_scene;
        scene.time_step = time_step;
        found = m_requests.try_emplace(time_step, make_frame_request(scene, m_volume, ranges)).first;
    }
    return found->second;
}

StillPicture AnimationPictures::draw(std::size_t frame, Renderer& renderer, const StillOptions& options,
                                     const TaskControl* control) {
    const AnimationFrame& wanted = m_frames.at(frame);
    const bool is_known = m_drawn_steps.contains(wanted.time_step);
    FrameRequest request = request_of(wanted.time_step, renderer.ranges());
    request.camera = wanted.camera;
    std::vector<FrameRemark> remarks = is_known ? std::vector<FrameRemark>() : remarks_on(m_scene, request);
    StillPicture still = draw_request(m_scene, std::move(request), m_volume, renderer, options, control);
    still.remarks.insert(still.remarks.begin(), remarks.begin(), remarks.end());
    m_drawn_steps.insert(wanted.time_step);
    m_missed.add(still.request, still.frame);
    return still;
}

std::vector<std::string> AnimationPictures::missed(VolumeRanges& ranges) const {
    if (m_drawn_steps.empty()) {
        return {};
    }
    return m_missed.remarks(m_scene, m_requests.at(*m_drawn_steps.begin()), ranges);
}

} // namespace elvis
