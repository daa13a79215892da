/**
 * @file asked_source.hpp
 * What a conversion plugin says of its elements, one at a time.
 */
#pragma once

#include <core/plugin_host/source_volume.hpp>

#include <array>
#include <vector>

namespace elvis::test {

inline std::vector<elvis_source_element> all_elements(const SourceVolume& source) {
    std::vector<elvis_source_element> elements(source.info().n_elements);
    source.elements(0, elements.size(), elements);
    return elements;
}

inline std::array<double, 3> position(const SourceVolume& source, std::uint64_t element, const std::array<double, 3>& xi) {
    std::array<double, 3> x{};
    source.evaluate_mapping(element, xi, x);
    return x;
}

/** All fields at a point. */
inline std::vector<double> sample(const SourceVolume& source, std::uint64_t element, const std::array<double, 3>& xi,
                                  std::uint32_t step = 0) {
    std::vector<double> values(source.n_values());
    source.sample(step, element, xi, values);
    return values;
}

} // namespace elvis::test
