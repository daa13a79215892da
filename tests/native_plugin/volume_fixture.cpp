#include "volume_fixture.hpp"

#include <core/plugin_host/plugin.hpp>

#include <Eigen/Dense>

#include <cmath>

namespace elvis::test {

std::shared_ptr<const Plugin> native_plugin() {
    static const std::shared_ptr<const Plugin> plugin = Plugin::load(ELVIS_NATIVE_PLUGIN);
    return plugin;
}

std::vector<double> fit(const native::Space& space, const std::function<double(const native::Point&)>& function) {
    const auto n = static_cast<Eigen::Index>(native::n_modes(space));
    Random random(7);
    Eigen::MatrixXd values(3 * n, n);
    Eigen::VectorXd target(3 * n);
    std::vector<double> modes(native::n_modes(space));
    for (Eigen::Index i = 0; i < 3 * n; ++i) {
        const native::Point xi = random.point(space.shape);
        native::evaluate_modes(space, xi, modes);
        values.row(i) = Eigen::Map<const Eigen::RowVectorXd>(modes.data(), n);
        target[i] = function(xi);
    }
    const Eigen::VectorXd solution = values.colPivHouseholderQr().solve(target);
    return {solution.begin(), solution.end()};
}

namespace {

/** Coefficients of a random function whose values are about 1 at most. */
std::vector<double> unit_noise(const native::Space& space, Random& random) {
    std::vector<double> coefficients = smooth_coefficients(space, random);
    double largest = 0;
    for (int i = 0; i < 50; ++i)
        largest = std::max(largest, std::abs(native::evaluate(space, coefficients, random.point(space.shape))));
    for (double& coefficient : coefficients)
        coefficient /= largest;
    return coefficients;
}

} // namespace

TestVolume::TestVolume(std::vector<ClassPlan> classes, std::vector<native::Field> fields, std::vector<double> times,
                       double centre, double bend, const std::function<double(const native::Point&)>& function) {
    m_description.fields = std::move(fields);
    m_description.times = std::move(times);
    m_description.boundary_groups = {"wall", "inflow"};
    m_description.notes = {{"source file", "random"}};
    for (const ClassPlan& plan : classes)
        m_description.classes.push_back({plan.geometry, plan.fields, plan.n_elements});
    m_description.dimension = native::dimension(classes[0].geometry.shape);
    m_description.n_faces =
        m_description.dimension == 3 && m_description.n_elements() > static_cast<std::uint64_t>(example_face().element) ? 1 : 0;

    Random random(11);
    for (const ClassPlan& plan : classes) {
        std::vector<double>& numbers = m_geometry.emplace_back();
        std::array<std::vector<double>, 3> reference;
        for (std::size_t direction = 0; direction < 3; ++direction)
            reference[direction] = fit(plan.geometry, [&](const native::Point& xi) { return centre + xi[direction]; });
        for (std::uint64_t element = 0; element < plan.n_elements; ++element)
            for (std::size_t direction = 0; direction < 3; ++direction) {
                const std::vector<double> noise = unit_noise(plan.geometry, random);
                for (std::size_t i = 0; i < noise.size(); ++i)
                    numbers.push_back(reference[direction][i] + bend * noise[i]);
            }
    }
    for (std::size_t field = 0; field < m_description.fields.size(); ++field)
        for (std::size_t time = 0; time < m_description.times.size(); ++time)
            for (const ClassPlan& plan : classes) {
                std::vector<double>& numbers = m_fields.emplace_back();
                for (std::uint64_t i = 0; i < plan.n_elements * m_description.fields[field].n_components; ++i) {
                    const std::vector<double> coefficients =
                        function ? fit(plan.fields[field], function) : smooth_coefficients(plan.fields[field], random);
                    numbers.insert(numbers.end(), coefficients.begin(), coefficients.end());
                }
            }

    native::Writer writer(path(), m_description);
    const auto n_elements = static_cast<std::int64_t>(m_description.n_elements());
    std::int64_t number = n_elements;
    for (std::size_t i = 0; i < classes.size(); ++i) {
        writer.write_geometry(i, 0, classes[i].n_elements, m_geometry[i]);
        std::vector<std::int64_t> numbers(classes[i].n_elements);
        for (std::int64_t& entry : numbers)
            entry = --number;
        writer.write_numbers(i, 0, classes[i].n_elements, numbers);
        for (std::size_t field = 0; field < m_description.fields.size(); ++field)
            for (std::size_t time = 0; time < m_description.times.size(); ++time)
                writer.write_field(field, time, i, 0, classes[i].n_elements,
                                   m_fields[(field * m_description.times.size() + time) * classes.size() + i]);
    }
    if (m_description.n_faces == 1) {
        const native::Face face = example_face();
        writer.write_faces(0, 1, std::span(&face, 1));
    }
    writer.commit();
}

std::uint64_t TestVolume::first_element(std::size_t element_class) const {
    std::uint64_t first = 0;
    for (std::size_t i = 0; i < element_class; ++i)
        first += m_description.classes[i].n_elements;
    return first;
}

std::span<const double> TestVolume::geometry(std::size_t element_class, std::uint64_t local, std::size_t direction) const {
    const std::size_t n = native::n_modes(m_description.classes[element_class].geometry);
    return std::span(m_geometry[element_class]).subspan((local * 3 + direction) * n, n);
}

std::span<const double> TestVolume::field(std::size_t field, std::size_t time_step, std::size_t element_class,
                                          std::uint64_t local, std::size_t component) const {
    const std::size_t n = native::n_modes(m_description.classes[element_class].fields[field]);
    const std::size_t n_classes = m_description.classes.size();
    const std::vector<double>& numbers = m_fields[(field * m_description.times.size() + time_step) * n_classes + element_class];
    return std::span(numbers).subspan((local * m_description.fields[field].n_components + component) * n, n);
}

RuntimeVolume TestVolume::open() const { return RuntimeVolume(native_plugin(), path()); }

} // namespace elvis::test
