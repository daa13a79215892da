#include "arrays.hpp"

#include <pybind11/stl.h>

namespace elvis::python {

namespace py = pybind11;

namespace {

template <class Number> using Array = py::array_t<Number, py::array::c_style | py::array::forcecast>;

} // namespace

const double* ArrayVolume::keep(const py::handle& array) {
    const auto numbers = py::cast<Doubles>(array);
    m_kept.push_back(numbers);
    return numbers.data();
}

elvis_space ArrayVolume::space(const py::dict& of) {
    auto result = detail::sized<elvis_space>();
    result.basis = py::cast<elvis_basis>(of["basis"]);
    const auto order = py::cast<std::vector<std::uint32_t>>(of["order"]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        result.order[axis] = order.at(axis);
    }
    result.nodes = of["nodes"].is_none() ? nullptr : keep(of["nodes"]);
    return result;
}

ArrayVolume::ArrayVolume(std::uint32_t dimension, const py::list& classes, const py::list& fields,
                         const std::vector<double>& times, const std::vector<std::string>& groups)
    : m_times(times) {
    for (const py::handle& item : classes) {
        const auto of = py::cast<py::dict>(item);
        auto& element_class = m_classes.emplace_back(detail::sized<elvis_array_class>());
        element_class.shape = py::cast<elvis_shape>(of["shape"]);
        element_class.n_elements = py::cast<std::uint64_t>(of["n_elements"]);
        element_class.geometry_space = &m_spaces.emplace_back(std::vector{space(of)}).front();
        element_class.geometry = keep(of["geometry"]);
        if (!of["corners"].is_none()) {
            const auto corners = py::cast<Array<std::int64_t>>(of["corners"]);
            m_kept.push_back(corners);
            element_class.corners = corners.data();
        }
        if (!of["face_groups"].is_none()) {
            const auto face_groups = py::cast<Array<std::int32_t>>(of["face_groups"]);
            m_kept.push_back(face_groups);
            element_class.face_groups = face_groups.data();
        }
    }
    for (const py::handle& item : fields) {
        const auto of = py::cast<py::dict>(item);
        auto& field = m_fields.emplace_back(detail::sized<elvis_array_field>());
        field.name = m_texts.emplace_back(py::cast<std::string>(of["name"])).c_str();
        field.unit = m_texts.emplace_back(py::cast<std::string>(of["unit"])).c_str();
        field.n_components = py::cast<std::uint32_t>(of["components"]);
        field.continuity = py::cast<elvis_continuity>(of["continuity"]);
        auto& spaces = m_spaces.emplace_back();
        for (const py::handle& its : py::cast<py::list>(of["spaces"])) {
            spaces.push_back(space(py::cast<py::dict>(its)));
        }
        field.spaces = spaces.data();
        auto& values = m_values.emplace_back();
        for (const py::handle& array : py::cast<py::list>(of["values"])) {
            values.push_back(keep(array));
        }
        field.values = values.data();
    }
    for (const std::string& group : groups) {
        m_groups.push_back(m_texts.emplace_back(group).c_str());
    }
    m_arrays = detail::sized<elvis_arrays>();
    m_arrays.dimension = dimension;
    m_arrays.n_classes = static_cast<std::uint32_t>(m_classes.size());
    m_arrays.n_fields = static_cast<std::uint32_t>(m_fields.size());
    m_arrays.n_time_steps = static_cast<std::uint32_t>(m_times.size());
    m_arrays.n_boundary_groups = static_cast<std::uint32_t>(m_groups.size());
    m_arrays.classes = m_classes.data();
    m_arrays.fields = m_fields.data();
    m_arrays.times = m_times.data();
    m_arrays.boundary_groups = m_groups.data();
}

} // namespace elvis::python
