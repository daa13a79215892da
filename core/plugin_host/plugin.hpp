/**
 * @file plugin.hpp
 * A loaded plugin library, and the registry of all that were found.
 */
#pragma once

#include <elvis/apex_bounds.h>
#include <elvis/converter.h>
#include <elvis/extrema.h>
#include <elvis/formats.h>
#include <elvis/parts.h>
#include <elvis/plugin.h>
#include <elvis/runtime.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace elvis {

/** What files of a plugin are called; see elvis/formats.h. */
struct FileFormat {
    std::string name;
    /** With their dots; '#' is a digit. */
    std::vector<std::string> endings;
};

/** A loaded library with a valid descriptor. Unloaded when the last shared_ptr (registry, volumes, sources) goes. */
class Plugin {
public:
    /** Loads and checks. Throws Error with the reason for refusal. */
    static std::shared_ptr<const Plugin> load(const std::filesystem::path& library);
    /**
     * What a program gives to show its own data: a table without probe, open and close, which must stay as long as this. `id`
     * is for messages. Throws Error for a table that lacks functions.
     */
    static std::shared_ptr<const Plugin> of_program(const elvis_runtime& runtime, std::string id,
                                                    const elvis_apex_bounds* apex_bounds = nullptr);
    /** The native volume's, of the library that this program is linked to: it serves volumes in memory. */
    static std::shared_ptr<const Plugin> of_native(std::string id);
    /** A mesh in memory, as its converter gives it, without probe and open. */
    static std::shared_ptr<const Plugin> of_mesh(const elvis_converter& converter, std::string id);
    ~Plugin();
    Plugin(const Plugin&) = delete;
    Plugin& operator=(const Plugin&) = delete;

    const std::filesystem::path& library() const;
    const std::string& id() const;
    const std::string& name() const;
    const std::string& version() const;
    const std::string& vendor() const;
    const std::string& description() const;
    std::uint32_t abi_version() const;
    /** Empty if the plugin does not tell. */
    const std::vector<FileFormat>& formats() const;

    /**
     * The interface tables, or null. They are copies of the size this host knows, with members beyond the plugin's own
     * struct_size set to null; required functions are known to be there.
     */
    const elvis_runtime* runtime() const;
    const elvis_converter* converter() const;
    const elvis_extrema* extrema() const;
    const elvis_apex_bounds* apex_bounds() const;
    const elvis_parts* parts() const;

private:
    Plugin();
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

/** A version of the interface (ELVIS_ABI_VERSION) for people: "1.0". */
std::string abi_version_text(std::uint32_t version);

/** A library that was found and not accepted. */
struct RefusedPlugin {
    std::filesystem::path library;
    std::string reason;
};

/**
 * Finds plugins in the folders that the host has decided on (core/base/host.hpp), else: the folders of $ELVIS_PLUGIN_PATH
 * (separated by ':'), the user's folder
 * ($XDG_DATA_HOME or ~/.local/share)/elvis/plugins, then lib/elvis/plugins of the installation (or build) that the program
 * or the shared library runs from. The first plugin with an id wins; later ones are refused as duplicates.
 */
class PluginRegistry {
public:
    /** Searches and loads. Never throws because of a plugin. */
    PluginRegistry();

    const std::vector<std::shared_ptr<const Plugin>>& plugins() const { return m_plugins; }
    const std::vector<RefusedPlugin>& refused() const { return m_refused; }
    static std::vector<std::filesystem::path> search_path();

    /** The plugin with this id; Error that lists the ids if there is none. */
    std::shared_ptr<const Plugin> find(const std::string& id) const;

    /** The runtime plugin most sure of the file, or an Error that says what those answered that failed. Missing file: Error. */
    std::shared_ptr<const Plugin> runtime_for(const std::string& path) const;
    /** The conversion plugin most sure of the file. */
    std::shared_ptr<const Plugin> converter_for(const std::string& path) const;

private:
    std::vector<std::shared_ptr<const Plugin>> m_plugins;
    std::vector<RefusedPlugin> m_refused;
};

} // namespace elvis
