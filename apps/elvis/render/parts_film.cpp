#include "parts_film.hpp"
#include "film.hpp"

#include <core/base/counted.hpp>
#include <core/base/error.hpp>
#include <core/parts/draw_in_parts.hpp>
#include <core/scene/output/png_file.hpp>
#include <core/scene/resolve.hpp>
#include <core/session/animation_pictures.hpp>

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

namespace elvis::commands {

namespace {

namespace fs = std::filesystem;

/** A still scene for each picture, with its time step and camera; colours mean the same in all. Called by all of a group. */
std::vector<Scene> frames_of(const Scene& scene, const RuntimeVolume& whole, VolumeInParts& parts) {
    if (scene.warp && (scene.animation->n_phases > 0 || scene.animation->time_steps)) {
        throw Error(scene.volume,
                    "a warp that differs from picture to picture cannot be drawn in parts yet; without --parts it can");
    }
    Scene still = scene;
    still.range_steps = steps_of_animation(scene, whole);
    still.animation.reset();
    if (!still.range_steps.empty()) {
        still.time_step = still.range_steps.front();
    }
    // Where the camera stands follows from bounds and ranges that the group finds out together.
    const Camera camera = parts.draw(still, false).still.request.camera;
    std::vector<Scene> all;
    for (const AnimationFrame& frame : animation_frames(*scene.animation, still.range_steps, scene.time_step, camera)) {
        Scene& one = all.emplace_back(still);
        one.time_step = frame.time_step;
        set_camera(one.camera, frame.camera);
    }
    return all;
}

/** A group's pictures. */
class GroupPictures {
public:
    GroupPictures(const RenderArguments& arguments, VolumeInParts& parts, Team& group)
        : m_arguments(arguments), m_parts(parts), m_group(group), m_folder(arguments.output) {}

    void draw(std::uint32_t frame, const Scene& scene) {
        const fs::path file = m_folder / frame_name(frame);
        // The group's first decides for all.
        if (m_group.of_first({m_arguments.resume && fs::exists(file) ? 1.0 : 0.0}).front() != 0) {
            return;
        }
        const PartsPicture picture = m_parts.draw(scene, false);
        if (m_group.is_first()) {
            write_png(picture.still.frame, file.string(), m_arguments.bits);
            tell(frame, picture.still.remarks);
        }
    }

private:
    /** What is to be known of several pictures is told of the first. */
    void tell(std::uint32_t frame, const std::vector<FrameRemark>& remarks) {
        for (const FrameRemark& remark : remarks) {
            if (m_told.insert(remark.text).second) {
                spdlog::log(remark.is_warning ? spdlog::level::warn : spdlog::level::info, "{}: {}", frame_name(frame),
                            remark.text);
            }
        }
    }

    const RenderArguments& m_arguments;
    VolumeInParts& m_parts;
    Team& m_group;
    fs::path m_folder;
    std::set<std::string> m_told;
};

} // namespace

void render_parts_film(const RenderArguments& arguments, const Scene& scene, const VolumeToPart& volume, const Device& device,
                       Partition partition, DivisibleTeam& team, const TaskControl& control) {
    const std::uint32_t n_groups = std::max(1u, team.size() / partition.n_parts());
    const std::unique_ptr<Team> group = team.group(n_groups);
    fs::create_directories(arguments.output);
    const std::unique_ptr<PartedVolume> parted = volume.parted(control);
    VolumeInParts parts(*parted, device, scene.precision.value_or(Precision::float32), std::move(partition), *group, &control);
    const std::vector<Scene> frames = frames_of(scene, volume.whole, parts);
    GroupPictures pictures(arguments, parts, *group);
    for (auto frame = team.group_number(n_groups); frame < frames.size(); frame += n_groups) {
        pictures.draw(frame, frames[frame]);
    }
    double all_are_done = 0;
    team.minimum(std::span(&all_are_done, 1));
    if (!team.is_first()) {
        return;
    }
    spdlog::info("{} in {}, by {}", counted(frames.size(), "picture"), arguments.output,
                 counted(n_groups, "group") + " of processes");
    if (!arguments.film.empty()) {
        make_film(fs::path(arguments.output) / frame_pattern, scene.animation->frames_a_second, arguments.film);
    }
}

} // namespace elvis::commands
