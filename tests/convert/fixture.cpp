#include "fixture.hpp"

#include <catch2/catch.hpp>
#include <core/plugin_host/plugin.hpp>

#include <cstdlib>
#include <fstream>
#include <random>

elvis::SourceVolume generate(const std::string& description) {
    static const auto plugin = elvis::Plugin::load(GENERATOR_PLUGIN);
    const TemporaryFolder folder;
    return elvis::SourceVolume(plugin, {folder.write("description.json", description)});
}

elvis::SourceVolume open_dat(const std::string& path) {
    static const auto plugin = elvis::Plugin::load(DAT_PLUGIN);
    return elvis::SourceVolume(plugin, {path});
}

ConvertedVolume::ConvertedVolume(const elvis::SourceVolume& source, const elvis::ConvertOptions& options) {
    namespace native = elvis::native;
    const TemporaryFolder folder;
    const std::string path = folder.path("volume.h5");
    m_report = elvis::convert(source, path, options, {});
    CHECK(names_in(folder).size() == 1);
    const native::Reader reader(path);
    m_description = reader.description();
    m_place.resize(m_description.n_elements());
    m_faces.resize(m_description.n_faces);
    reader.read_faces(0, m_faces.size(), m_faces);
    m_fields.resize(m_description.times.size());
    for (auto& of_step : m_fields)
        of_step.resize(m_description.fields.size());
    for (std::size_t c = 0; c < m_description.classes.size(); ++c) {
        const native::ElementClass& element_class = m_description.classes[c];
        const std::uint64_t n = element_class.n_elements;
        std::vector<std::int64_t> numbers(n);
        reader.read_numbers(c, 0, n, numbers);
        for (std::uint64_t index = 0; index < n; ++index)
            m_place.at(static_cast<std::size_t>(numbers[index])) = {c, index};
        m_geometry.emplace_back(n * 3 * native::n_modes(element_class.geometry));
        reader.read_geometry(c, 0, n, m_geometry.back());
        for (std::size_t step = 0; step < m_fields.size(); ++step)
            for (std::size_t field = 0; field < m_description.fields.size(); ++field) {
                auto& numbers_of_field = m_fields[step][field];
                numbers_of_field.emplace_back(n * m_description.fields[field].n_components *
                                              native::n_modes(element_class.fields[field]));
                reader.read_field(field, step, c, 0, n, numbers_of_field.back());
            }
    }
}

elvis::native::Shape ConvertedVolume::shape(std::uint64_t element) const {
    return m_description.classes[m_place[element].element_class].geometry.shape;
}

std::vector<double> ConvertedVolume::field_coefficients(std::uint64_t element, std::size_t field, std::size_t component,
                                                        std::size_t step) const {
    const auto [c, index] = m_place[element];
    const std::size_t n = elvis::native::n_modes(m_description.classes[c].fields[field]);
    const auto first = m_fields[step][field][c].begin() +
                       static_cast<std::ptrdiff_t>((index * m_description.fields[field].n_components + component) * n);
    return {first, first + static_cast<std::ptrdiff_t>(n)};
}

std::array<double, 3> ConvertedVolume::position(std::uint64_t element, const elvis::native::Point& xi,
                                                std::array<elvis::native::Point, 3>* jacobian) const {
    const auto [c, index] = m_place[element];
    const elvis::native::Space& space = m_description.classes[c].geometry;
    const std::size_t n = elvis::native::n_modes(space);
    std::array<double, 3> x;
    for (std::size_t d = 0; d < 3; ++d) {
        elvis::native::Point row;
        x[d] = elvis::native::evaluate(space, {m_geometry[c].data() + (3 * index + d) * n, n}, xi, row);
        if (jacobian)
            (*jacobian)[d] = row;
    }
    return x;
}

double ConvertedVolume::value(std::uint64_t element, std::size_t field, const elvis::native::Point& xi,
                              elvis::native::Point* gradient, std::size_t component, std::size_t step) const {
    const elvis::native::Space& space = m_description.classes[m_place[element].element_class].fields[field];
    elvis::native::Point g;
    const double result = elvis::native::evaluate(space, field_coefficients(element, field, component, step), xi, g);
    if (gradient) {
        // Solve J^T (world gradient) = g by Cramer's rule.
        std::array<elvis::native::Point, 3> j;
        position(element, xi, &j);
        const auto cross = [](const elvis::native::Point& a, const elvis::native::Point& b) {
            return elvis::native::Point{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
        };
        const auto dot = [](const elvis::native::Point& a, const elvis::native::Point& b) {
            return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        };
        const double determinant = dot(j[0], cross(j[1], j[2]));
        *gradient = {dot(g, cross(j[1], j[2])) / determinant, dot(g, cross(j[2], j[0])) / determinant,
                     dot(g, cross(j[0], j[1])) / determinant};
    }
    return result;
}

elvis::native::Point random_point(elvis::native::Shape shape) {
    static std::mt19937 generator(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double a = uniform(generator), b = uniform(generator), c = uniform(generator);
    return elvis::native::expand(shape, {a, b, c});
}
