#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

elvis::SourceVolume open_pyfr(const std::vector<std::string>& paths) {
    static const auto plugin = elvis::Plugin::load(PYFR_PLUGIN);
    return elvis::SourceVolume(plugin, paths);
}

std::string pyfr_data(const std::string& name) { return elvis::test::data_file("pyfr/" + name); }

std::string failure(const std::vector<std::string>& paths) {
    try {
        open_pyfr(paths);
    } catch (const elvis::Error& error) {
        return error.what();
    }
    return "no failure";
}

std::vector<std::string> field_names(const elvis::SourceVolume& source) {
    std::vector<std::string> names;
    for (const auto& field : source.fields()) {
        names.push_back(field.name);
    }
    return names;
}

std::array<double, 3> from_pyfr(const std::string& kind, const std::array<double, 3>& x) {
    if (kind == "pri") {
        return {x[0], -x[2], x[1]};
    }
    if (kind == "pyr") {
        return {x[0] - (1 + x[2]) / 2, x[1] - (1 + x[2]) / 2, x[2]};
    }
    return x;
}
