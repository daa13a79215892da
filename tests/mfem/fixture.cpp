#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

#include <cstdlib>
#include <fstream>
#include <sstream>

elvis::SourceVolume open_mfem(const std::vector<std::string>& paths) {
    static const auto plugin = elvis::Plugin::load(MFEM_PLUGIN);
    return elvis::SourceVolume(plugin, paths);
}

std::string mfem_data(const std::string& name) { return elvis::test::data_file("mfem/" + name); }

std::string space_text(const std::string& collection, int n_components, int ordering) {
    return "FiniteElementSpace\nFiniteElementCollection: " + collection + "\nVDim: " + std::to_string(n_components) +
           "\nOrdering: " + std::to_string(ordering) + "\n\n";
}

std::string failure(const std::vector<std::string>& paths) {
    try {
        open_mfem(paths);
    } catch (const elvis::Error& error) {
        return error.what();
    }
    return "no failure";
}

elvis_source_element get_element(const elvis::SourceVolume& source, std::uint64_t number) {
    elvis_source_element element{};
    element.struct_size = sizeof element;
    source.elements(number, 1, std::span(&element, 1));
    return element;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what);
    REQUIRE(at != std::string::npos);
    return text.replace(at, what.size(), by);
}

std::array<double, 3> from_mfem(int geometry, const std::array<double, 3>& x) {
    if (geometry == 6) {
        return {2 * x[0] - 1, 1 - 2 * x[2], 2 * x[1] - 1};
    }
    return {2 * x[0] - 1, 2 * x[1] - 1, 2 * x[2] - 1};
}

std::vector<ReferencePoint> read_reference(const std::string& path, std::size_t n_components) {
    std::vector<ReferencePoint> points;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line.front() == '#') {
            continue;
        }
        std::istringstream words(line);
        ReferencePoint point;
        std::array<double, 3> ip;
        words >> point.element >> point.geometry >> ip[0] >> ip[1] >> ip[2] >> point.x[0] >> point.x[1] >> point.x[2];
        const auto xi = from_mfem(point.geometry, ip);
        point.xi = {xi[0], xi[1], xi[2]};
        point.value.resize(n_components);
        for (double& value : point.value) {
            words >> value;
        }
        REQUIRE(words);
        points.push_back(point);
    }
    return points;
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
