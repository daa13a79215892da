#include "volume_to_part.hpp"

#include <core/base/error.hpp>
#include <core/session/volume/joined.hpp>
#include <core/session/volume/warped.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace elvis::commands {

namespace {

/** `said`: the Scene, or the SceneJoin, whose file is `path`. */
template <class Files>
VolumeFile find_file(const std::string& path, const Files& said, const PluginRegistry& plugins, Team& team,
                     const TaskControl& control) {
    std::vector<std::string> files{path};
    files.insert(files.end(), said.more_files.begin(), said.more_files.end());
    const auto find = [&] { return find_volume(plugins, files, said.plugin, said.plugin_options, control); };
    // What has to be converted, the first converts; the others then find it in the cache.
    std::optional<VolumeFile> file;
    if (team.is_first()) {
        file = find();
    }
    double no_number = 0;
    team.minimum(std::span(&no_number, 1));
    if (!file) {
        file = find();
    }
    return *file;
}

std::shared_ptr<const native::VolumeSource> source_of(const VolumeFile& file, const char* key) {
    if (file.plugin->id() != native_plugin_id) {
        throw Error(file.path, "only native volumes, and what is converted to them, can be " + std::string(key));
    }
    return native_source(file.path);
}

} // namespace

VolumeToPart open_to_part(const Scene& scene, const PluginRegistry& plugins, Team& team, const TaskControl& control) {
    std::vector<VolumeFile> files{find_file(scene.volume, scene, plugins, team, control)};
    const std::string path = files.front().path;
    if (files.front().plugin->id() != native_plugin_id && scene.joined.empty() && !scene.warp) {
        RuntimeVolume whole = files.front().open(&control);
        return {std::move(files), nullptr, nullptr, std::move(whole)};
    }
    std::shared_ptr<const native::VolumeSource> source =
        source_of(files.front(), scene.joined.empty() ? "displaced (warp)" : "joined (joined)");
    std::vector<native::Joined> joined;
    for (const SceneJoin& join : scene.joined) {
        if (!join.path.empty()) {
            files.push_back(find_file(join.path, join, plugins, team, control));
        }
        joined.push_back({join.name, join.path.empty() ? source : source_of(files.back(), "joined (joined)"), join.time_step});
    }
    if (!joined.empty()) {
        source = joined_source(std::move(source), std::move(joined), path);
    }
    if (scene.warp) {
        VolumeToPart volume = displaced(std::move(source), scene, path, control);
        volume.files = std::move(files);
        return volume;
    }
    RuntimeVolume whole = serve_native(source, path, &control);
    return {std::move(files), std::move(source), nullptr, std::move(whole)};
}

VolumeToPart displaced(std::shared_ptr<const native::VolumeSource> undeformed, const Scene& scene, const std::string& name,
                       const TaskControl& control) {
    std::shared_ptr<const native::VolumeSource> source = warped_source(undeformed, *scene.warp, scene.time_step, name);
    RuntimeVolume whole = serve_native(source, name, &control);
    whole.set_undeformed([undeformed, name, &control] { return serve_native(undeformed, name, &control); });
    return {{}, std::move(source), std::move(undeformed), std::move(whole)};
}

} // namespace elvis::commands
