#include "vtk_fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace {

/** Native coordinates of a parametric point. A wedge's r and s may be either of xi1 and xi3: the one at the position. */
elvis::native::Point native_point(const elvis::SourceVolume& source, const VtkReference& reference) {
    elvis_source_element element{};
    element.struct_size = sizeof element;
    source.elements(reference.cell, 1, {&element, 1});
    const auto [r, s, t] = reference.parametric;
    if (element.shape == ELVIS_SHAPE_PYRAMID) {
        return {2 * r * (1 - t) - 1, 2 * s * (1 - t) - 1, 2 * t - 1};
    }
    if (element.shape != ELVIS_SHAPE_PRISM) {
        return {2 * r - 1, 2 * s - 1, 2 * t - 1};
    }
    const elvis::native::Point one{2 * r - 1, 2 * t - 1, 2 * s - 1}, other{2 * s - 1, 2 * t - 1, 2 * r - 1};
    const auto distance = [&](const elvis::native::Point& xi) {
        std::array<double, 3> x;
        source.evaluate_mapping(reference.cell, xi, x);
        return std::hypot(x[0] - reference.position[0], x[1] - reference.position[1], x[2] - reference.position[2]);
    };
    return distance(one) < distance(other) ? one : other;
}

} // namespace

elvis::SourceVolume open_vtk(const std::vector<std::string>& paths) {
    static const auto plugin = elvis::Plugin::load(VTK_PLUGIN);
    return elvis::SourceVolume(plugin, paths);
}

std::string sample_file(const std::string& name) { return elvis::test::data_file("vtk/" + name); }

std::string failure_of(const std::string& content, const std::string& name) {
    const TemporaryFolder folder;
    try {
        open_vtk({folder.write(name, content)});
    } catch (const elvis::Error& error) {
        return error.what();
    }
    return "no failure";
}

std::vector<VtkReference> read_reference(const std::string& name) {
    std::ifstream file(sample_file(name));
    std::vector<VtkReference> references;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with('#')) {
            continue;
        }
        std::istringstream numbers(line);
        VtkReference& reference = references.emplace_back();
        numbers >> reference.cell >> reference.type;
        for (auto* array : {&reference.parametric, &reference.position}) {
            for (double& number : *array) {
                numbers >> number;
            }
        }
        for (double& number : reference.values) {
            numbers >> number;
        }
        REQUIRE(numbers);
    }
    REQUIRE(!references.empty());
    return references;
}

Difference source_difference(const elvis::SourceVolume& source, const std::vector<VtkReference>& references) {
    Difference difference;
    for (const VtkReference& reference : references) {
        const elvis::native::Point xi = native_point(source, reference);
        std::array<double, 3> x;
        source.evaluate_mapping(reference.cell, xi, x);
        std::vector<double> values(source.n_values());
        source.sample(0, reference.cell, xi, values);
        Difference here;
        for (std::size_t i = 0; i < 3; ++i) {
            here.position = std::max(here.position, std::abs(x[i] - reference.position[i]));
        }
        for (std::size_t i = 0; i < 4; ++i) {
            here.value = std::max(here.value, std::abs(values[i] - reference.values[i]));
        }
        INFO("cell " << reference.cell << " of type " << reference.type);
        CHECK(here.position < 1e-10);
        CHECK(here.value < 1e-10);
        difference.position = std::max(difference.position, here.position);
        difference.value = std::max(difference.value, here.value);
    }
    return difference;
}

Difference converted_difference(const elvis::SourceVolume& source, const ConvertedVolume& volume,
                                const std::vector<VtkReference>& references) {
    Difference difference;
    for (const VtkReference& reference : references) {
        const elvis::native::Point xi = native_point(source, reference);
        const std::array<double, 3> x = volume.position(reference.cell, xi);
        for (std::size_t i = 0; i < 3; ++i) {
            difference.position = std::max(difference.position, std::abs(x[i] - reference.position[i]));
        }
        for (std::size_t i = 0; i < 4; ++i) {
            const double value = volume.value(reference.cell, i == 0 ? 0 : 1, xi, nullptr, i == 0 ? 0 : i - 1);
            difference.value = std::max(difference.value, std::abs(value - reference.values[i]));
        }
    }
    return difference;
}
