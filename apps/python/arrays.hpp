/**
 * @file arrays.hpp
 * Volumes from numpy's arrays: elvis_arrays from what the package hands over (elvis/_arrays.py).
 */
#pragma once

#include <elvis/elvis.hpp>
#include <pybind11/numpy.h>

#include <deque>
#include <string>
#include <vector>

namespace elvis::python {

using Doubles = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/** An elvis_arrays with all that it points to. */
class ArrayVolume {
public:
    /**
     * `classes`: of each element class a dict of shape, n_elements, basis, order (3), nodes (or None), geometry, corners and
     * face_groups (or None). `fields`: dicts of name, unit, components, continuity, spaces (dicts of basis, order, nodes) and
     * values (a list of arrays, by time step, then class). The package has checked shapes.
     */
    ArrayVolume(std::uint32_t dimension, const pybind11::list& classes, const pybind11::list& fields,
                const std::vector<double>& times, const std::vector<std::string>& groups);

    const elvis_arrays& arrays() const { return m_arrays; }

private:
    elvis_space space(const pybind11::dict& of);
    const double* keep(const pybind11::handle& array);

    elvis_arrays m_arrays{};
    std::vector<elvis_array_class> m_classes;
    std::vector<elvis_array_field> m_fields;
    /** Addresses of these stay. */
    std::deque<std::string> m_texts;
    std::deque<std::vector<elvis_space>> m_spaces;
    std::deque<std::vector<const double*>> m_values;
    std::vector<elvis_string> m_groups;
    std::vector<double> m_times;
    std::vector<pybind11::object> m_kept;
};

} // namespace elvis::python
