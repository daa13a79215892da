#include "parts_film.hpp"
#include "film.hpp"

#include <core/base/counted.hpp>
#include <core/parts/draw_in_parts.hpp>
#include <core/scene/output/png_file.hpp>
#include <core/scene/resolve.hpp>
#include <core/session/animation_pictures.hpp>

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <utility>

namespace elvis::commands {

namespace {

namespace fs = std::filesystem;

/** The volume in parts, displaced as the scene that is drawn says. */
class PartsOfScenes {
public:
    PartsOfScenes(const VolumeToPart& volume, const Device& device, Precision precision, Partition partition, Team& team,
                  const TaskControl& control)
        : m_volume(volume), m_device(device), m_precision(precision), m_partition(std::move(partition)), m_team(team),
          m_control(control) {}

    /** Called by all of the group. Kept until a scene is displaced in another way. */
    VolumeInParts& of(const Scene& scene) {
        const std::pair moment(scene.time_step, scene.warp ? scene.warp->phase : 0);
        if (!m_parts || (scene.warp && moment != m_moment)) {
            m_moment = moment;
            m_parts.reset();
            m_parted.reset();
            m_displaced.reset();
            if (scene.warp) {
                m_displaced.emplace(displaced(m_volume.undeformed, scene, m_volume.whole.path(), m_control));
            }
            m_parted = (m_displaced ? *m_displaced : m_volume).parted(m_control);
            m_parts.emplace(*m_parted, m_device, m_precision, m_partition, m_team, &m_control);
        }
        return *m_parts;
    }

private:
    const VolumeToPart& m_volume;
    const Device& m_device;
    Precision m_precision;
    Partition m_partition;
    Team& m_team;
    const TaskControl& m_control;
    std::pair<std::uint32_t, double> m_moment;
    std::optional<VolumeToPart> m_displaced;
    std::unique_ptr<PartedVolume> m_parted;
    std::optional<VolumeInParts> m_parts;
};

/** A still scene for each picture, with its time step, phase and camera; colours mean the same in all. Called by all of a
 * group. */
std::vector<Scene> frames_of(const Scene& scene, const RuntimeVolume& whole, PartsOfScenes& parts) {
    Scene still = scene;
    still.range_steps = steps_of_animation(scene, whole);
    still.animation.reset();
    if (!still.range_steps.empty()) {
        still.time_step = still.range_steps.front();
    }
    // Where the camera stands follows from bounds and ranges that the group finds out together.
    const Camera camera = parts.of(scene).draw(still, false).still.request.camera;
    std::vector<Scene> all;
    for (const AnimationFrame& frame : animation_frames(*scene.animation, still.range_steps, scene.time_step, camera)) {
        Scene& one = all.emplace_back(still);
        one.time_step = frame.time_step;
        if (one.warp && frame.phase) {
            one.warp->phase = *frame.phase;
        }
        set_camera(one.camera, frame.camera);
    }
    return all;
}

/** A group's pictures. */
class GroupPictures {
public:
    GroupPictures(const RenderArguments& arguments, PartsOfScenes& parts, Team& group)
        : m_arguments(arguments), m_parts(parts), m_group(group), m_folder(arguments.output) {}

    void draw(std::uint32_t frame, const Scene& scene) {
        const fs::path file = m_folder / frame_name(frame);
        // The group's first decides for all.
        if (m_group.of_first({m_arguments.resume && fs::exists(file) ? 1.0 : 0.0}).front() != 0) {
            return;
        }
        const PartsPicture picture = m_parts.of(scene).draw(scene, false);
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
    PartsOfScenes& m_parts;
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
    PartsOfScenes parts(volume, device, scene.precision.value_or(Precision::float32), std::move(partition), *group, control);
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
