#include "nek5000_fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

elvis::SourceVolume open_nek5000(const std::vector<std::string>& paths) {
    static const auto plugin = elvis::Plugin::load(NEK5000_PLUGIN);
    return elvis::SourceVolume(plugin, paths);
}

std::string sample_file(const std::string& name) { return elvis::test::data_file("nek5000/" + name); }

std::string failure(const std::vector<std::string>& paths) {
    try {
        const elvis::SourceVolume source = open_nek5000(paths);
        for (std::size_t step = 0; step < source.times().size(); ++step) {
            for (std::uint64_t element = 0; element < source.info().n_elements; ++element) {
                sample(source, step, element, {0.1, 0.2, 0.3});
            }
        }
    } catch (const elvis::Error& error) {
        return error.what();
    }
    return "no failure";
}

std::vector<double> sample(const elvis::SourceVolume& source, std::size_t step, std::uint64_t element,
                           const elvis::native::Point& xi) {
    std::vector<double> values(source.n_values());
    source.sample(static_cast<std::uint32_t>(step), element, xi, values);
    return values;
}

elvis::native::Point position(const elvis::SourceVolume& source, std::uint64_t element, const elvis::native::Point& xi) {
    elvis::native::Point x{};
    source.evaluate_mapping(element, xi, x);
    return x;
}

std::size_t field_index(const elvis::SourceVolume& source, const std::string& name) {
    std::size_t index = 0;
    while (index < source.fields().size() && source.fields()[index].name != name) {
        ++index;
    }
    REQUIRE(index < source.fields().size());
    return index;
}
