/**
 * @file test_files.hpp
 * Temporary volumes for tests, and the program's way to open them.
 */
#pragma once

#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdlib>
#include <filesystem>
#include <string>

#include <unistd.h>

namespace elvis::oracle {

/** A name in the system's temporary folder; the file is removed at the end. */
class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& name)
        : m_path(std::filesystem::temp_directory_path() / ("elvis-" + std::to_string(::getpid()) + "-" + name)) {}
    ~TemporaryFile() {
        std::error_code ignored;
        std::filesystem::remove(m_path, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    std::string path() const { return m_path.string(); }

private:
    std::filesystem::path m_path;
};

/** Opens with the plugins of this build. */
inline RuntimeVolume open_volume(const std::string& path) {
    ::setenv("ELVIS_PLUGIN_PATH", ELVIS_TEST_PLUGINS, 1);
    const PluginRegistry registry;
    return RuntimeVolume(registry.runtime_for(path), path);
}

} // namespace elvis::oracle
