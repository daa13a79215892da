/**
 * @file level_rule.hpp
 * Quadrature on the surface where an expression has a value, in a box of a block of an element.
 *
 * R. I. Saye, "High-order quadrature methods for implicitly defined surfaces and volumes in hyperrectangles" (SIAM J. Sci.
 * Comput. 37, 2015): along an axis in which the expression is monotone the surface is a graph over a rectangle, or over the
 * part of it in which the expression has different signs at the two ends. That part is cut out by the same idea one dimension
 * lower, and Gauss points lie on the pieces. What is monotone is judged by the derivatives at a lattice of points; the caller
 * compares rules and divides boxes.
 */
#pragma once

#include <core/integrate/level_function.hpp>
#include <core/integrate/reference_rule.hpp>

#include <array>
#include <vector>

namespace elvis {

/** Of the block's cube [0,1]^3. */
struct BlockBox {
    Vector3 lower{}, upper{1, 1, 1};
};

/** How the surface lies in a box. */
class LevelRule {
public:
    /** Looks at the expression at a lattice of points. */
    LevelRule(LevelFunction& function, const BlockBox& box);

    /** The surface surely, as far as the lattice tells, misses the box. */
    bool is_missed() const { return m_is_missed; }
    /** The surface is a graph over parts of rectangles that are simple enough. If not, the box is to be divided. */
    bool is_usable() const { return m_is_usable; }

    /** Appends points with n nodes a direction to a piece; vectors point to where the expression is larger. Needs is_usable().
     */
    void append_points(unsigned n, ReferencePoints& points);

private:
    static constexpr std::size_t n_lattice = 3;
    /** One end of the box along the height, as a function over the base: its sign is the same everywhere, or it has zeros. */
    struct End {
        double height = 0;
        bool has_zeros = false;
        bool is_positive = false;
    };
    /** A point of the base, by its outer and inner coordinate, and the weight of it. */
    struct BaseNode {
        double outer = 0, inner = 0, weight = 0;
    };

    struct OuterNode {
        double outer = 0, weight = 0;
        /** Where pieces along the inner axis begin and end. */
        std::vector<double> inner_breaks;
    };
    /** Of the inner axis, at an outer node. */
    struct InnerPiece {
        std::size_t node = 0;
        double from = 0, to = 0;
    };

    const LevelSample& sample(std::size_t i, std::size_t j, std::size_t k) const;
    double step(std::size_t axis) const { return (m_box.upper[axis] - m_box.lower[axis]) / (n_lattice - 1); }
    bool is_far_from_zero(const LevelSample& sample, std::array<bool, 3> axes) const;
    bool is_monotone(std::size_t axis, std::array<std::size_t, 3> first, std::array<std::size_t, 3> last) const;
    End end_at(bool is_upper) const;
    void choose_height();
    void choose_inner_axis();

    Vector3 point(double outer, double inner, double height) const;
    /** Where along an axis the expression is zero between two points at which its signs differ, for many pairs at once. */
    std::vector<double> roots(std::size_t axis, const std::vector<Vector3>& from, double lower, double upper);
    std::vector<double> outer_breaks();
    std::vector<OuterNode> outer_nodes(const GaussLine& line);
    void add_inner_breaks(const End& end, std::vector<OuterNode>& nodes);
    std::vector<InnerPiece> crossed_pieces(std::vector<OuterNode>& nodes);
    std::vector<BaseNode> base_nodes(unsigned n);

    LevelFunction& m_function;
    BlockBox m_box;
    std::vector<LevelSample> m_lattice;
    bool m_is_missed = false, m_is_usable = false;
    std::size_t m_height = 0, m_inner = 0, m_outer = 0;
    std::array<End, 2> m_ends;
};

} // namespace elvis
