/**
 * @file test_volumes.hpp
 * The program's ways to make and open volumes for tests.
 */
#pragma once

#include <core/base/temporary_folder.hpp>
#include <core/convert/convert.hpp>
#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <tests/support/device.hpp>

#include <cstdlib>
#include <fstream>
#include <string>

namespace elvis::oracle {

using test::device;

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
