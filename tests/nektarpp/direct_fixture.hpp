/**
 * @file direct_fixture.hpp
 * Nektar++ files opened for rendering, without conversion.
 */
#pragma once

#include "fixture.hpp"
#include "nektar_writer.hpp"

#include <core/plugin_host/plugin.hpp>
#include <core/plugin_host/runtime_volume.hpp>
#include <tests/support/error_of.hpp>

#include <random>

inline elvis::RuntimeVolume open_direct(const std::string& path, const std::string& options = {}) {
    static const auto plugin = elvis::Plugin::load(NEKTARPP_PLUGIN);
    return elvis::RuntimeVolume(plugin, path, options);
}

inline std::vector<double> uniform_numbers(std::size_t n, unsigned seed, double lower = -1, double upper = 1) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<double> uniform(lower, upper);
    std::vector<double> numbers(n);
    for (double& number : numbers) {
        number = uniform(generator);
    }
    return numbers;
}

/** A bent element of its own, number 0 and id 7, in a file. */
inline std::string bent_element(elvis::native::Shape shape) {
    nektar_writer::Element element;
    element.shape = shape;
    element.n_along = 4;
    const bool is_flat = elvis::native::dimension(shape) == 2;
    element.map = [is_flat](const nektar_writer::Point& xi) -> nektar_writer::Point {
        const auto [a, b, c] = xi;
        if (is_flat) {
            return {a + 0.1 * b * b * b - 0.07 * a * b, b + 0.05 * a * a * b + 0.04 * a * a, 0};
        }
        return {a + 0.1 * b * b * c - 0.07 * a * b, b + 0.05 * a * a * a + 0.08 * b * c,
                c - 0.06 * a * b * c + 0.09 * a * a * b};
    };
    return nektar_writer::geometry_file(element);
}

/** A space as a field file names it. */
inline nektar_writer::Block block_of(const elvis::native::Space& space, const std::vector<double>& coefficients,
                                     const std::string& field = "u", const std::string& id = "7") {
    using elvis::native::Basis;
    using elvis::native::Shape;
    const std::string family = space.basis == Basis::modified       ? "Modified_"
                               : space.basis == Basis::orthogonal   ? "Ortho_"
                               : space.basis == Basis::gll_lagrange ? "GLL_Lagrange"
                                                                    : "Gauss_Lagrange";
    const bool is_lagrange = space.basis == Basis::gll_lagrange || space.basis == Basis::gauss_lagrange;
    const auto factor = [&](const char* last) { return is_lagrange ? family : std::string(family) += last; };
    const bool is_modified = space.basis == Basis::modified;
    const auto [name, basis] = [&]() -> std::pair<std::string, std::vector<std::string>> {
        switch (space.shape) {
        case Shape::hexahedron:
            return {"Hexahedron", {factor("A"), factor("A"), factor("A")}};
        case Shape::prism:
            return {"Prism", {factor("A"), factor("A"), factor("B")}};
        case Shape::pyramid:
            return {"Pyramid", {factor("A"), factor("A"), is_modified ? "ModifiedPyr_C" : "OrthoPyr_C"}};
        case Shape::tetrahedron:
            return {"Tetrahedron", {factor("A"), factor("B"), factor("C")}};
        case Shape::quadrilateral:
            return {"Quadrilateral", {factor("A"), factor("A")}};
        default:
            return {"Triangle", {factor("A"), factor("B")}};
        }
    }();
    std::string bases, modes = "UNIORDER:";
    for (std::size_t direction = 0; direction < basis.size(); ++direction) {
        bases.append(direction ? "," : "").append(basis[direction]);
        modes.append(direction ? "," : "").append(std::to_string(space.order[direction] + 1));
    }
    return {field, name, bases, modes, id, coefficients};
}
