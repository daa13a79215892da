/**
 * @file glsl_leaves.hpp
 * The leaves of an expression in GLSL: what an element gives.
 */
#pragma once

#include <core/expression/glsl.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace elvis::expression_glsl {

/** What an element gives, read once for one function. */
class LeafWriter {
public:
    /** @param needed  the nodes of the function; expression and element_class must outlive the writer. */
    LeafWriter(const Expression& expression, const ExpressionClass& element_class, const std::vector<NodeId>& needed);

    /** Declarations of all that the leaves stand on. */
    std::string declarations() const;

    std::string leaf(const Node& node) const;

    /** What the device's value of a field lacks. */
    double offset(const Node& node) const;

    static bool is_of_field(Operation operation);
    std::size_t slot(std::uint32_t field) const;
    static std::string field_suffix(std::size_t slot, std::uint32_t component) {
        return std::to_string(slot) + "_" + std::to_string(component);
    }
    static std::string instance_suffix(std::size_t slot) {
        return slot == 0 ? std::string() : std::string("_").append(std::to_string(slot));
    }

    /** Values alone, values with gradients in xi whatever the leaves say. */
    void raise_fields(int level);
    void raise_geometry(int level) { m_geometry = std::max(m_geometry, level); }
    bool needs_position() const { return m_needs_position; }

private:
    /**
     * Levels of a field: 0 value, 1 gradient in xi, 2 world gradient, 3 bend, 4 world hessian; of geometry: 1 position,
     * 2 Jacobian, 3 second derivatives.
     */
    void note(const Node& node);

    std::string field(std::size_t slot, std::uint32_t component, int level) const;

    double order(std::uint32_t field) const;

    const Expression& m_expression;
    const ExpressionClass& m_class;
    /** By slot and component. */
    std::map<std::pair<std::size_t, std::uint32_t>, int> m_fields;
    int m_geometry = 0;
    bool m_needs_position = false;
    bool m_needs_inverse = false;
};

} // namespace elvis::expression_glsl
