/**
 * @file line_values.hpp
 * Fields along a straight line, as `elvis sample` finds them.
 */
#pragma once

#include <apps/serve/served.hpp>

#include <core/base/vector3.hpp>

#include <nlohmann/json.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace elvis::serve {

struct LineWishes {
    Vector3 from{}, to{};
    std::vector<std::string> fields;
    /** Points, ends included, beside those where elements begin and end. */
    std::size_t count = 2;
};

/**
 * `series` (name, and points [arc length, value], null where there is a gap), `breaks` (at, and the elements before and after),
 * `no_breaks_because`, `length`, `n_outside`, and `csv`, the file of `elvis sample`.
 */
nlohmann::json values_along(const Served& served, const Scene& scene, const LineWishes& wishes, const task& watch);

} // namespace elvis::serve
