#include "native_volume.hpp"

#include <core/base/error.hpp>
#include <core/session/warped.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace elvis::commands {

namespace {

VolumeFile find_file(const Scene& scene, const PluginRegistry& plugins, Team& team, const TaskControl& control) {
    std::vector<std::string> files{scene.volume};
    files.insert(files.end(), scene.more_files.begin(), scene.more_files.end());
    const auto find = [&] { return find_volume(plugins, files, scene.plugin, scene.plugin_options, control); };
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
    if (file->plugin->id() != native_plugin_id) {
        throw Error(scene.volume, "only native volumes, and what is converted to them, are drawn in parts; this is one of " +
                                      file->plugin->id() + " (elvis convert makes native volumes)");
    }
    return *file;
}

} // namespace

NativeVolume open_native(const Scene& scene, const PluginRegistry& plugins, Team& team, const TaskControl& control) {
    VolumeFile file = find_file(scene, plugins, team, control);
    std::shared_ptr<const native::VolumeSource> source = native_source(file.path);
    if (!scene.warp) {
        RuntimeVolume whole = file.open(&control);
        return {std::move(file), std::move(source), std::move(whole)};
    }
    auto displaced = warped_source(std::move(source), *scene.warp, scene.time_step, file.path);
    RuntimeVolume whole = serve_native(displaced, file.path, &control);
    return {std::move(file), std::move(displaced), std::move(whole)};
}

} // namespace elvis::commands
