#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

#include <cstdlib>
#include <fstream>
#include <iterator>

void run_gmsh(const TemporaryFolder& folder, const std::string& script, const std::string& options) {
    INFO("the gmsh program is needed (apt-get install gmsh), and is looked for when the build is configured");
    REQUIRE(std::filesystem::exists(GMSH_PROGRAM));
    folder.write("mesh.geo", script);
    const std::string command =
        "cd '" + folder.path("") + "' && '" + GMSH_PROGRAM + "' mesh.geo -v 2 " + options + " >log 2>&1";
    const int status = std::system(command.c_str());
    INFO(read_file(folder.path("log")));
    REQUIRE(status == 0);
}

elvis::SourceVolume open_msh(const std::vector<std::string>& paths) {
    static const auto plugin = elvis::Plugin::load(GMSH_PLUGIN);
    return elvis::SourceVolume(plugin, paths);
}

std::string failure(const std::vector<std::string>& paths) {
    try {
        open_msh(paths);
    } catch (const elvis::Error& error) {
        return error.what();
    }
    return "no failure";
}

std::vector<double> sample(const elvis::SourceVolume& source, std::uint64_t element, const Point& xi, std::uint32_t step) {
    std::vector<double> values(source.n_values());
    source.sample(step, element, xi, values);
    return values;
}

Point position(const elvis::SourceVolume& source, std::uint64_t element, const Point& xi) {
    Point x{};
    source.evaluate_mapping(element, xi, x);
    return x;
}

Converted::Converted(const elvis::SourceVolume& source) {
    static const auto plugin = elvis::Plugin::load(NATIVE_PLUGIN);
    const std::string path = m_folder.path("volume.h5");
    m_report = elvis::convert(source, path, {}, {});
    m_volume = std::make_unique<elvis::RuntimeVolume>(plugin, path);
    std::vector<std::int64_t> numbers(m_volume->n_elements());
    m_volume->element_numbers(0, numbers.size(), numbers);
    m_element.resize(numbers.size());
    for (std::size_t at = 0; at < numbers.size(); ++at) {
        m_element.at(static_cast<std::size_t>(numbers[at])) = at;
    }
}

Point Converted::position(std::uint64_t element, const Point& xi) const {
    Point x{};
    m_volume->evaluate_mapping(m_element.at(element), xi, x, {});
    return x;
}

std::vector<double> Converted::value(std::uint32_t field, std::uint64_t element, const Point& xi, std::uint32_t step) const {
    std::vector<double> values(m_volume->fields().at(field).n_components);
    m_volume->evaluate_field(field, step, m_element.at(element), xi, values, {});
    return values;
}

std::mt19937& random_numbers() {
    static std::mt19937 generator(1);
    return generator;
}

Point random_point(elvis::native::Shape shape) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    Point eta{};
    for (double& one : eta) {
        one = uniform(random_numbers());
    }
    Point xi = elvis::native::expand(shape, eta);
    if (elvis::native::dimension(shape) == 2) {
        xi[2] = 0;
    }
    return xi;
}

elvis::native::Shape shape_of(const elvis::SourceVolume& source, std::uint64_t element) {
    std::vector<elvis_source_element> elements(1);
    source.elements(element, 1, elements);
    return static_cast<elvis::native::Shape>(elements[0].shape);
}
