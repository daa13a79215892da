#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

elvis::SourceVolume open_hopr(const std::vector<std::string>& paths) {
    static const auto plugin = elvis::Plugin::load(HOPR_PLUGIN);
    return elvis::SourceVolume(plugin, paths);
}

std::string hopr_data(const std::string& name) { return elvis::test::data_file("hopr/" + name); }

std::string failure(const std::vector<std::string>& paths) {
    try {
        all_elements(open_hopr(paths));
    } catch (const elvis::Error& error) {
        return error.what();
    }
    return "no failure";
}
