#include "render_animation.hpp"
#include "film.hpp"
#include "output_endings.hpp"
#include "say_remarks.hpp"
#include <apps/elvis/long_task.hpp>

#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/scene/frame_request.hpp>
#include <core/scene/output/output_file.hpp>
#include <core/scene/output/png_file.hpp>
#include <core/session/missed_surfaces.hpp>
#include <core/session/picture_stats.hpp>

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>

namespace elvis::commands {

namespace {

namespace fs = std::filesystem;

/** The same for one run and the next, however many pictures there are. */
constexpr const char* name_pattern = "frame_%04d.png";

fs::path name_of(std::size_t frame) {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%04zu.png", frame);
    return name;
}

/** Of each time step; the colours stay the same over all of them. */
class Requests {
public:
    Requests(const Scene& scene, const std::vector<std::uint32_t>& steps, const RuntimeVolume& volume, VolumeRanges& ranges)
        : m_scene(scene), m_volume(volume), m_ranges(ranges) {
        m_scene.range_steps = steps;
        m_scene.time_step = steps.empty() ? scene.time_step : steps.front();
    }

    const FrameRequest& of(std::uint32_t time_step) {
        auto found = m_requests.find(time_step);
        if (found == m_requests.end()) {
            m_scene.time_step = time_step;
            found = m_requests.try_emplace(time_step, make_frame_request(m_scene, m_volume, m_ranges)).first;
            found->second.with_buffers = false;
            for (const std::string& remark : found->second.remarks) {
                spdlog::warn("time step {}: {}", time_step, remark);
            }
        }
        return found->second;
    }
    std::uint32_t first_step() const { return m_scene.range_steps.empty() ? m_scene.time_step : m_scene.range_steps.front(); }

private:
    Scene m_scene;
    const RuntimeVolume& m_volume;
    VolumeRanges& m_ranges;
    std::map<std::uint32_t, FrameRequest> m_requests;
};

} // namespace

void check_animation(const RenderArguments& arguments, const Scene& scene) {
    if (!scene.animation) {
        return;
    }
    for (const auto& [option, is_given] :
         {std::pair{"--buffers", !arguments.buffers.empty()}, std::pair{"--repeat", arguments.repeat > 0}}) {
        if (is_given) {
            throw UsageError(option, "is for one picture, not for an animation");
        }
    }
    if (fs::exists(arguments.output) && !fs::is_directory(arguments.output)) {
        throw UsageError("--output", "'" + arguments.output + "' is a file; an animation goes into a folder");
    }
    if (fs::path(arguments.output).extension() == ".png") {
        throw UsageError("--output", "'" + arguments.output + "' is the name of one picture; an animation goes into a folder");
    }
    if (!arguments.film.empty()) {
        need_film_ending("--film", arguments.film);
        require_film_maker();
    }
}

std::vector<std::uint32_t> drawn_steps(const Scene& scene, const RuntimeVolume& volume) {
    const auto& wanted = scene.animation->time_steps;
    return wanted ? steps_of(*wanted, volume.times().size(), scene.volume) : std::vector<std::uint32_t>{};
}

void render_animation(const RenderArguments& arguments, const Scene& scene, const Device& device, const RuntimeVolume& volume,
                      Renderer& renderer) {
    const SceneAnimation& animation = *scene.animation;
    const std::vector<std::uint32_t> steps = drawn_steps(scene, volume);
    Requests requests(scene, steps, volume, renderer.ranges());
    const std::vector<AnimationFrame> frames =
        animation_frames(animation, steps, scene.time_step, requests.of(requests.first_step()).camera);
    const fs::path folder = arguments.output;
    fs::create_directories(folder);
    TaskControl control;
    const InterruptGuard interrupts(control);
    const ProgressBar progress(control);
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    std::size_t n_kept = 0;
    MissedSurfaces missed;
    for (std::size_t number = 0; number < frames.size(); ++number) {
        const fs::path path = folder / name_of(number);
        if (arguments.resume && fs::exists(path)) {
            ++n_kept;
            continue;
        }
        control.progress(static_cast<double>(number) / static_cast<double>(frames.size()), path.filename().string());
        FrameRequest request = requests.of(frames[number].time_step);
        request.camera = frames[number].camera;
        request.sharing = sharing_of(arguments);
        Frame frame = renderer.render(request, &control);
        if (scene.annotation) {
            const AnnotationRequest annotation = make_annotation_request(*scene.annotation, request, frame, volume);
            for (const std::string& name : annotate(frame, annotation)) {
                spdlog::warn("annotation of {}: there is no room for the {}", path.filename().string(), name);
            }
        }
        write_png(frame, path.string(), arguments.bits);
        missed.add(request, frame);
        say(remarks_on(frame.counts));
        list.push_back({{"frame", number},
                        {"file", path.filename().string()},
                        {"time_step", request.time_step},
                        {"render_milliseconds", frame.render_milliseconds},
                        {"device_milliseconds", frame.device_milliseconds},
                        {"counts", counts_json(frame.counts)}});
    }
    // Pictures that were kept may show anything.
    if (n_kept == 0) {
        for (const std::string& remark : missed.remarks(scene, requests.of(requests.first_step()), renderer.ranges())) {
            spdlog::warn("in all pictures, {}", remark);
        }
    }
    spdlog::info("{} in {}, {} of them kept", counted(frames.size(), "picture"), folder.string(), n_kept);
    if (!arguments.stats.empty()) {
        const nlohmann::ordered_json root = {{"device", device.summary().name}, {"n_frames", frames.size()}, {"frames", list}};
        write_text_file(arguments.stats, root.dump(2) + "\n");
    }
    if (!arguments.film.empty()) {
        make_film(folder / name_pattern, animation.frames_a_second, arguments.film);
    }
}

} // namespace elvis::commands
