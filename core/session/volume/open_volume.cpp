#include <core/session/volume/open_volume.hpp>

#include <core/base/error.hpp>
#include <core/base/log.hpp>
#include <core/convert/kept_volumes.hpp>
#include <core/plugin_host/unknown_file.hpp>

#include <filesystem>

namespace elvis {

namespace {

std::string names_of(const std::vector<std::string>& paths) {
    std::string names;
    for (const std::string& path : paths) {
        const std::filesystem::path file(path);
        names += names.empty() ? "" : " ";
        names += (file.has_filename() ? file.filename() : file).string();
    }
    return names;
}

VolumeFile converted(const PluginRegistry& registry, const std::shared_ptr<const Plugin>& plugin,
                     const std::vector<std::string>& paths, const std::string& options, const TaskControl& control) {
    const KeptVolume kept = kept_volume(plugin, paths, options, control);
    // Said once; what is lost, each time.
    const LogLevel level = !is_exact(kept.report) ? LogLevel::warning : kept.is_new ? LogLevel::info : LogLevel::debug;
    log_line(level, "{}: converted by {}, {}; {} ({})", names_of(paths), plugin->id(), exactness(kept.report),
             kept.folder   ? "kept until the end, since there is no cache"
             : kept.is_new ? "kept in the cache"
                           : "from the cache",
             kept.path);
    return {registry.runtime_for(kept.path), kept.path, {}, kept.folder};
}

/** Null if no runtime plugin reads the file. */
std::shared_ptr<const Plugin> runtime_plugin(const PluginRegistry& registry, const std::string& path) {
    try {
        return registry.runtime_for(path);
    } catch (const Error&) {
        return nullptr;
    }
}

} // namespace

VolumeFile find_volume(const PluginRegistry& registry, const std::vector<std::string>& paths, const std::string& plugin,
                       const std::string& options, const TaskControl& control) {
    const std::string& first = paths.front();
    if (!plugin.empty()) {
        const std::shared_ptr<const Plugin> wanted = registry.find(plugin);
        const bool converts = wanted->converter() != nullptr && (paths.size() > 1 || wanted->runtime() == nullptr);
        return converts ? converted(registry, wanted, paths, options, control) : VolumeFile{wanted, first, options, {}};
    }
    const std::shared_ptr<const Plugin> drawing = runtime_plugin(registry, first);
    if (paths.size() == 1 && drawing) {
        return {drawing, first, options, {}};
    }
    std::shared_ptr<const Plugin> converter;
    try {
        converter = registry.converter_for(first);
    } catch (const Error& error) {
        if (drawing) {
            throw Error(first, "is a volume by itself: several files are one volume only where a plugin converts them");
        }
        throw unknown_file(registry, first, error);
    }
    return converted(registry, converter, paths, options, control);
}

} // namespace elvis
