#include <core/base/error.hpp>
#include <core/base/log.hpp>
#include <core/plugin_host/host_services.hpp>
#include <core/plugin_host/plugin.hpp>

#include <dlfcn.h>

#include <algorithm>
#include <system_error>

namespace elvis {

namespace fs = std::filesystem;

namespace {

/** Shared libraries of a folder, in the order of their names so that the result does not depend on the file system. */
std::vector<fs::path> libraries_in(const fs::path& folder) {
    std::vector<fs::path> libraries;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
        if (entry.path().extension() == ".so" && entry.is_regular_file(ignored)) {
            libraries.push_back(entry.path());
        }
    }
    std::sort(libraries.begin(), libraries.end());
    return libraries;
}

using Probe = elvis_result (*)(const elvis_host*, const char*, std::uint32_t*);

std::shared_ptr<const Plugin> most_confident(const std::vector<std::shared_ptr<const Plugin>>& plugins, const std::string& path,
                                             Probe (*probe_of)(const Plugin&), const char* kind) {
    if (std::error_code ignored; !fs::exists(path, ignored)) {
        throw Error(path, "there is no such file");
    }
    std::shared_ptr<const Plugin> best;
    std::uint32_t best_confidence = 0;
    int n_asked = 0;
    std::string complaints;
    for (const auto& plugin : plugins) {
        const Probe probe = probe_of(*plugin);
        if (!probe) {
            continue;
        }
        const HostServices services(plugin->id(), nullptr);
        std::uint32_t confidence = 0;
        services.begin("probe");
        try {
            services.check(probe(services.table(), path.c_str(), &confidence), "probe", path);
            ++n_asked;
        } catch (const Error& error) {
            ++n_asked;
            complaints += "\n  " + plugin->id() + ": " + error.what();
            confidence = 0;
        }
        if (confidence > best_confidence) {
            best = plugin;
            best_confidence = confidence;
        }
    }
    if (!best) {
        throw Error(path,
                    std::string("no ") + kind + " plugin reads this file" + (n_asked == 0 ? "; none was found" : complaints));
    }
    return best;
}

/** Where an installation, or a build, has plugins: seen from the shared library that this code is in, or from the program. */
std::vector<fs::path> folders_of_installation() {
    std::error_code ignored;
    const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
    static const char in_this_image = 0;
    Dl_info here{};
    if (dladdr(&in_this_image, &here) != 0 && here.dli_fname != nullptr) {
        const fs::path image = fs::canonical(here.dli_fname, ignored);
        if (!ignored && image != program && image.string().find(".so") != std::string::npos) {
            return {image.parent_path() / "elvis/plugins"};
        }
    }
    const fs::path prefix = program.parent_path().parent_path();
    return {prefix / "lib/elvis/plugins", prefix / ELVIS_LIBRARY_FOLDER / "elvis/plugins"};
}

} // namespace

std::vector<fs::path> PluginRegistry::search_path() {
    if (const auto& decided = host().plugin_folders) {
        return *decided;
    }
    std::vector<fs::path> folders;
    if (const auto list = environment_variable("ELVIS_PLUGIN_PATH")) {
        folders = split_folders(*list);
    }
    if (const auto data = environment_variable("XDG_DATA_HOME")) {
        folders.push_back(fs::path(*data) / "elvis/plugins");
    } else if (const auto home = environment_variable("HOME")) {
        folders.push_back(fs::path(*home) / ".local/share/elvis/plugins");
    }
    for (const fs::path& folder : folders_of_installation()) {
        if (std::find(folders.begin(), folders.end(), folder) == folders.end()) {
            folders.push_back(folder);
        }
    }
    return folders;
}

PluginRegistry::PluginRegistry() {
    for (const fs::path& folder : search_path()) {
        for (const fs::path& library : libraries_in(folder)) {
            try {
                std::shared_ptr<const Plugin> plugin = Plugin::load(library);
                const auto same_id = [&](const auto& other) { return other->id() == plugin->id(); };
                const auto earlier = std::find_if(m_plugins.begin(), m_plugins.end(), same_id);
                if (earlier != m_plugins.end()) {
                    m_refused.push_back({library, "has the id " + plugin->id() + " of " + (*earlier)->library().string() +
                                                      ", which was found first"});
                } else {
                    m_plugins.push_back(std::move(plugin));
                }
            } catch (const Error& error) {
                log_warning("plugin refused: {}", error.what());
                m_refused.push_back({library, error.cause()});
            }
        }
    }
}

std::shared_ptr<const Plugin> PluginRegistry::find(const std::string& id) const {
    std::string known;
    for (const auto& plugin : m_plugins) {
        if (plugin->id() == id) {
            return plugin;
        }
        known += (known.empty() ? "" : ", ") + plugin->id();
    }
    throw Error("no plugin has the id '" + id + "'; found are: " + (known.empty() ? "none" : known));
}

std::shared_ptr<const Plugin> PluginRegistry::runtime_for(const std::string& path) const {
    return most_confident(
        m_plugins, path, [](const Plugin& plugin) -> Probe { return plugin.runtime() ? plugin.runtime()->probe : nullptr; },
        "runtime");
}

std::shared_ptr<const Plugin> PluginRegistry::converter_for(const std::string& path) const {
    return most_confident(
        m_plugins, path, [](const Plugin& plugin) -> Probe { return plugin.converter() ? plugin.converter()->probe : nullptr; },
        "conversion");
}

} // namespace elvis
