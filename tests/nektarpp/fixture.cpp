#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/base/error.hpp>
#include <core/plugin_host/plugin.hpp>

#include <cstdlib>
#include <fstream>
#include <iterator>

elvis::SourceVolume open_nektar(const std::vector<std::string>& paths) {
    static const auto plugin = elvis::Plugin::load(NEKTARPP_PLUGIN);
    return elvis::SourceVolume(plugin, paths);
}

std::string failure(const std::vector<std::string>& paths) {
    try {
        open_nektar(paths);
    } catch (const elvis::Error& error) {
        return error.what();
    }
    return "no failure";
}

std::string sample_file(const std::string& name) { return elvis::test::data_file("nektarpp/" + name); }

Converted::Converted(const elvis::SourceVolume& source, std::size_t field, std::size_t time_step) {
    const TemporaryFolder folder;
    m_report = elvis::convert(source, folder.path("volume.h5"), {}, {});
    m_volume = std::make_unique<elvis::oracle::Volume>(elvis::oracle::read_volume(folder.path("volume.h5"), field, time_step));
    m_place.resize(m_volume->n_elements());
    for (std::size_t element = 0; element < m_place.size(); ++element) {
        m_place.at(static_cast<std::size_t>(m_volume->number(element))) = element;
    }
}

std::array<double, 3> Converted::position(std::uint64_t number, const std::array<double, 3>& xi) const {
    const elvis::oracle::Vector x = m_volume->position(m_place[number], {xi[0], xi[1], xi[2]});
    return {x[0], x[1], x[2]};
}

double Converted::value(std::uint64_t number, const std::array<double, 3>& xi) const {
    return m_volume->field(m_place[number], {xi[0], xi[1], xi[2]})[0];
}

double value_at(const elvis::SourceVolume& source, std::uint64_t element, const std::array<double, 3>& xi, std::size_t field,
                std::uint32_t time_step) {
    std::vector<double> values(source.n_values());
    source.sample(time_step, element, xi, values);
    return values[field];
}

std::array<double, 3> position_at(const elvis::SourceVolume& source, std::uint64_t element, const std::array<double, 3>& xi) {
    std::array<double, 3> x{};
    source.evaluate_mapping(element, xi, x);
    return x;
}
