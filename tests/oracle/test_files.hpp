/**
 * @file test_files.hpp
 * Temporary volumes for tests, and the program's ways to make and open them.
 */
#pragma once

#include <core/convert/convert.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
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

/** The plugins of this build. */
inline const PluginRegistry& plugins() {
    static const PluginRegistry registry = [] {
        ::setenv("ELVIS_PLUGIN_PATH", ELVIS_TEST_PLUGINS, 1);
        return PluginRegistry();
    }();
    return registry;
}

inline RuntimeVolume open_volume(const std::string& path) { return RuntimeVolume(plugins().runtime_for(path), path); }

/** Converts a foreign file to a native volume. */
inline ConvertReport convert_file(const std::string& input, const std::string& output) {
    const SourceVolume source(plugins().converter_for(input), {input});
    return convert(source, output, {}, {});
}

/** Converts what a text for the generator plugin describes. */
inline ConvertReport generate(const std::string& description, const std::string& output) {
    const TemporaryFile input("description.json");
    std::ofstream(input.path()) << description;
    return convert_file(input.path(), output);
}

} // namespace elvis::oracle
