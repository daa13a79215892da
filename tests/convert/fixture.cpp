#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/plugin_host/plugin.hpp>

#include <cstdlib>
#include <fstream>

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "elvis-convert-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    m_path = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
}

std::string TemporaryFolder::write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
}

std::size_t TemporaryFolder::n_files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(m_path), std::filesystem::directory_iterator()));
}

elvis::SourceVolume generate(const std::string& description) {
    static const auto plugin = elvis::Plugin::load(GENERATOR_PLUGIN);
    const TemporaryFolder folder;
    return elvis::SourceVolume(plugin, {folder.write("description.json", description)});
}

elvis::SourceVolume open_dat(const std::string& path) {
    static const auto plugin = elvis::Plugin::load(DAT_PLUGIN);
    return elvis::SourceVolume(plugin, {path});
}

std::string test_data(const std::string& name) {
    const std::string path = std::string(ELVIS_TEST_DATA) + "/" + name;
    INFO("set -DELVIS_TEST_DATA to the folder of real data sets");
    INFO(path);
    REQUIRE(std::filesystem::exists(path));
    return path;
}
