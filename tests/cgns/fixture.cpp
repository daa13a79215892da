#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

#include <cstdlib>
#include <map>

elvis::SourceVolume open_cgns(const std::vector<std::string>& paths) {
    static const auto plugin = elvis::Plugin::load(CGNS_PLUGIN);
    return elvis::SourceVolume(plugin, paths);
}

std::string write_cgns(const TemporaryFolder& folder, const std::string& kind, const std::string& container,
                       const std::string& linked) {
    const std::string name = kind + "_" + container + ".cgns";
    const std::string command = "cd '" + folder.path("") + "' && '" + CGNS_WRITER + "' " + kind + " " + container + " " + name +
                                (linked.empty() ? "" : " " + linked) + " >log 2>&1";
    const int status = std::system(command.c_str());
    INFO(elvis::test::read_file(folder.path("log")));
    REQUIRE(status == 0);
    return folder.path(name);
}

std::string failure(const std::string& path) {
    try {
        open_cgns({path});
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

Point random_point(elvis::native::Shape shape) {
    static std::mt19937 generator(20261126);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Point eta{uniform(generator), uniform(generator), uniform(generator)};
    Point xi = elvis::native::expand(shape, eta);
    if (elvis::native::dimension(shape) == 2) {
        xi[2] = 0;
    }
    return xi;
}

std::string n_faces_by_group(const elvis::SourceVolume& source) {
    std::map<std::string, int> counts;
    for (const elvis_source_element& element : all_elements(source)) {
        for (const std::int32_t group : element.face_groups) {
            if (group != ELVIS_GROUP_NONE) {
                ++counts[source.boundary_groups().at(static_cast<std::size_t>(group))];
            }
        }
    }
    std::string all;
    for (const auto& [name, count] : counts) {
        all += (all.empty() ? "" : ", ") + name + " " + std::to_string(count);
    }
    return all;
}
