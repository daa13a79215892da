/**
 * @file element_classes.hpp
 * Elements of one shape whose mapping and fields have the same bases and orders.
 */
#pragma once

#include "../reader/field/field_series.hpp"
#include "record.hpp"

#include <elvis/plugin.hpp>

#include <string>
#include <vector>

namespace nektarpp {

struct ElementClass {
    Space geometry;
    /** By field. */
    std::vector<Space> fields;
    /** Position of its first element, counted class by class. */
    std::uint64_t first = 0;
    std::uint64_t n_elements = 0;
    /** For the snippet, by field. */
    std::vector<std::vector<elvis_constant>> constants;
    /** Nodes of Lagrange bases, in GLSL. */
    std::string nodes_text;
    std::vector<elvis_text> sources;
};

struct ElementClasses {
    std::vector<ElementClass> classes;
    /** Elements of the mesh by position, and the other way round. */
    std::vector<std::uint64_t> number_of, position_of;

    /** Throws elvis::api::Error for what the snippet cannot draw. */
    ElementClasses(const Mesh& mesh, const FieldSeries& series);

    const ElementClass& at_position(std::uint64_t position) const;
};

} // namespace nektarpp
