#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/plugin_host/plugin.hpp>

#include <cstdlib>
#include <fstream>
#include <sstream>

elvis::SourceVolume open_mfem(const std::vector<std::string>& paths) {
    static const auto plugin = elvis::Plugin::load(MFEM_PLUGIN);
    return elvis::SourceVolume(plugin, paths);
}

std::string mfem_data(const std::string& name) { return elvis::test::data_file("mfem/" + name); }

std::array<double, 3> from_mfem(int geometry, const std::array<double, 3>& x) {
    if (geometry == 6) {
        return {2 * x[0] - 1, 1 - 2 * x[2], 2 * x[1] - 1};
    }
    return {2 * x[0] - 1, 2 * x[1] - 1, 2 * x[2] - 1};
}

Converted convert_mfem(const elvis::SourceVolume& source, std::size_t field) {
    const TemporaryFolder folder;
    const std::string path = folder.path("volume.h5");
    auto report = elvis::convert(source, path, {}, {});
    elvis::oracle::Volume volume(elvis::oracle::read_volume(path, field));
    std::vector<std::size_t> place(volume.n_elements());
    for (std::size_t element = 0; element < place.size(); ++element) {
        place.at(static_cast<std::size_t>(volume.number(element))) = element;
    }
    return {std::move(report), std::move(volume), std::move(place)};
}
