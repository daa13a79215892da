/**
 * @file expression.hpp
 * Derived fields: expressions over the fields of a volume, their gradients, coordinates, and what an element is like.
 *
 *     numbers        1  2.5  1e-3  pi
 *     operators      + - * / ^   < <= > >= == !=   && || !   condition ? a : b     (conditions are the numbers 1 and 0)
 *     functions      sqrt abs min max sin cos tan asin acos atan atan2 exp log log10 pow norm dot cross
 *                    modulus(re, im) argument(re, im)
 *     fields         p   u[0]   "heat flux"   'heat flux'[1]
 *     coordinates    x y z
 *     derivatives    d(e, x)  grad(e)  div(v)  curl(v)  vorticity(v)  laplacian(e)  q_criterion(v)
 *     the element    jacobian  scaled_jacobian  order  order(p)  element
 *
 * Numbers and vectors. A field of several components is a vector. Vectors are added, subtracted, negated, multiplied and
 * divided by numbers; the functions named for vectors take them; [i] takes a component. Anywhere else, also as the result, a
 * vector means its magnitude: `u + 1` is |u| + 1. grad of a vector is a matrix, [i][j] = d u_i / d x_j; norm takes matrices,
 * too.
 *
 * Names. What is quoted is a field. A field goes before a constant or coordinate of the same name, which is then written @x,
 * @pi,
 * @order; only in d(e, x) is x always the coordinate. A name before a parenthesis is a function.
 *
 * Meaning. Derivatives without further words are by world coordinates. jacobian: determinant of dx/dxi; scaled_jacobian: of the
 * same with columns of unit length; order: the largest of the field's orders in the element (without a field: of all fields);
 * q_criterion: (|W|^2 - |S|^2) / 2 of the antisymmetric and symmetric parts of grad(v). element: the number that people know
 * the element by; in single precision exact to 2^24. 0 times anything counts as 0. A length has the derivative 0 where it is 0.
 */
#pragma once

#include <core/expression/graph.hpp>
#include <core/plugin_host/runtime_volume.hpp>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace elvis {

class Expression {
public:
    /**
     * Parses `text` over the fields of a volume. Whatever is wrong is an Error that names text, column and cause; unknown names
     * name the nearest known one.
     */
    Expression(const std::string& text, std::span<const FieldInfo> fields, std::uint32_t dimension = 3);

    /** An expression in x, y and z alone: the function of an implicit surface. */
    static Expression implicit(const std::string& text);

    const std::string& text() const { return m_text; }
    const Graph& graph() const { return m_graph; }
    NodeId value() const { return m_value; }

    /**
     * Derivatives of the value: by reference coordinates, or by world coordinates if is_implicit(). None where they would take
     * third derivatives, or second ones on a surface.
     */
    const std::optional<std::array<NodeId, 3>>& gradient() const { return m_gradient; }
    bool is_implicit() const { return m_is_implicit; }

    /** Fields of the volume that take part, each once: field slot k of the shaders is fields()[k]. */
    const std::vector<std::uint32_t>& fields() const { return m_fields; }

    /** A field's component, or its magnitude (component -1), if the expression is no more than that. */
    struct PlainField {
        std::uint32_t field = 0;
        std::int32_t component = 0;
    };
    const std::optional<PlainField>& plain() const { return m_plain; }

    /** The value rests on `order` or `element`, which plugins tell one call at a time. */
    bool needs_element_facts() const;
    /** What the value rests on. */
    bool needs_gradients() const;
    bool needs_second_derivatives() const;
    /** What value and gradient() rest on. */
    bool gradient_needs_second_derivatives() const;

private:
    Expression() = default;
    void find_gradient(std::uint32_t dimension);
    bool has(const std::vector<NodeId>& roots, std::span<const Operation> operations) const;

    std::string m_text;
    Graph m_graph;
    NodeId m_value = 0;
    std::optional<std::array<NodeId, 3>> m_gradient;
    std::vector<std::uint32_t> m_fields;
    std::optional<PlainField> m_plain;
    bool m_is_implicit = false;
};

} // namespace elvis
