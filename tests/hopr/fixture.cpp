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

std::vector<elvis_source_element> all_elements(const elvis::SourceVolume& source) {
    std::vector<elvis_source_element> elements(source.info().n_elements);
    source.elements(0, elements.size(), elements);
    return elements;
}

std::array<double, 3> position(const elvis::SourceVolume& source, std::uint64_t element, const std::array<double, 3>& xi) {
    std::array<double, 3> x{};
    source.evaluate_mapping(element, xi, x);
    return x;
}

std::vector<double> sample(const elvis::SourceVolume& source, std::uint64_t element, const std::array<double, 3>& xi,
                           std::uint32_t step) {
    std::vector<double> values(source.n_values());
    source.sample(step, element, xi, values);
    return values;
}
