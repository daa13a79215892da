#include "finite_element.hpp"

#include "basis_1d.hpp"
#include "functionals.hpp"
#include "spanning_set.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace elvis_mfem {

namespace {

using Functionals = std::vector<Functional>;

/** Largest matrix that is inverted for a basis: a second or two of work. */
constexpr std::size_t max_dofs_of_inverse = 1800;

/** Products of one-dimensional functions, in a pyramid of the collapsed coordinates x/(1-z), y/(1-z), z. */
class TensorElement : public FiniteElement {
public:
    TensorElement(const Collection& collection, Geometry geometry, const Functionals& dofs)
        : FiniteElement(dofs.size(), 1), m_line(collection.basis, collection.order + 1),
          m_dimension(static_cast<std::size_t>(dimension(geometry))), m_is_collapsed(geometry == Geometry::pyramid) {
        for (const Functional& dof : dofs) {
            const Point x = collapse(dof.node);
            m_places.push_back({m_line.nearest(x[0]), m_line.nearest(x[1]), m_dimension == 3 ? m_line.nearest(x[2]) : 0});
        }
    }

    void evaluate(const Point& x, double* values) const override {
        std::array<std::array<double, max_order + 1>, 3> lines;
        const Point at = collapse(x);
        lines[2][0] = 1;
        for (std::size_t d = 0; d < m_dimension; ++d) {
            m_line.evaluate(at[d], lines[d].data());
        }
        for (const auto& place : m_places) {
            *values++ = lines[0][place[0]] * lines[1][place[1]] * lines[2][place[2]];
        }
    }

private:
    Point collapse(const Point& x) const { return m_is_collapsed ? collapsed(x) : x; }

    Basis1d m_line;
    std::size_t m_dimension;
    bool m_is_collapsed;
    std::vector<std::array<std::size_t, 3>> m_places;
};

/** Nedelec and Raviart-Thomas squares and cubes: each function has one component, a product of one-dimensional functions. */
class VectorTensorElement : public FiniteElement {
public:
    VectorTensorElement(const Collection& collection, std::size_t dimension, const Functionals& dofs)
        : FiniteElement(dofs.size(), dimension), m_is_nd(collection.family == Family::nd),
          m_closed(collection.basis, collection.polynomial_order() + 1),
          m_open(collection.open_basis, collection.polynomial_order()) {
        for (const Functional& dof : dofs) {
            Function function;
            while (dof.direction[function.axis] == 0) {
                ++function.axis;
            }
            function.sign = dof.direction[function.axis];
            for (std::size_t d = 0; d < n_components(); ++d) {
                function.place[d] = (is_open(d, function.axis) ? m_open : m_closed).nearest(dof.node[d]);
            }
            m_functions.push_back(function);
        }
    }

    void evaluate(const Point& x, double* values) const override {
        std::array<std::array<double, max_order + 1>, 3> closed, open;
        for (std::size_t d = 0; d < n_components(); ++d) {
            m_closed.evaluate(x[d], closed[d].data());
            m_open.evaluate(x[d], open[d].data());
        }
        std::fill_n(values, n_components() * n_dofs(), 0.0);
        for (std::size_t dof = 0; dof < m_functions.size(); ++dof) {
            const Function& function = m_functions[dof];
            double product = function.sign;
            for (std::size_t d = 0; d < n_components(); ++d) {
                product *= (is_open(d, function.axis) ? open : closed)[d][function.place[d]];
            }
            values[function.axis * n_dofs() + dof] = product;
        }
    }

private:
    struct Function {
        std::size_t axis = 0;
        double sign = 1;
        std::array<std::size_t, 3> place{};
    };

    bool is_open(std::size_t direction, std::size_t axis) const { return (direction == axis) == m_is_nd; }

    bool m_is_nd;
    Basis1d m_closed;
    Basis1d m_open;
    std::vector<Function> m_functions;
};

/** Bernstein polynomials on a simplex, i! j! k! l! for the index of each function. */
class Bernstein {
public:
    Bernstein(int order, std::size_t dimension, const std::vector<Point>& nodes) : m_order(order) {
        for (const Point& node : nodes) {
            std::array<int, 4> index{order, 0, 0, 0};
            double factor = std::tgamma(order + 1.0);
            for (std::size_t d = 0; d < dimension; ++d) {
                index[d + 1] = static_cast<int>(std::lround(order * node[d]));
                index[0] -= index[d + 1];
            }
            for (int i : index) {
                factor /= std::tgamma(i + 1.0);
            }
            m_indices.push_back(index);
            m_factors.push_back(factor);
        }
    }

    void evaluate(const Point& x, std::size_t dimension, double* values) const {
        std::array<std::array<double, max_order + 1>, 4> powers;
        std::array<double, 4> lambda{1, 0, 0, 0};
        for (std::size_t d = 0; d < dimension; ++d) {
            lambda[d + 1] = x[d];
            lambda[0] -= x[d];
        }
        for (std::size_t d = 0; d < 4; ++d) {
            powers[d][0] = 1;
            for (std::size_t i = 1; i <= static_cast<std::size_t>(m_order); ++i) {
                powers[d][i] = powers[d][i - 1] * lambda[d];
            }
        }
        for (std::size_t n = 0; n < m_indices.size(); ++n) {
            values[n] = m_factors[n];
            for (std::size_t d = 0; d < 4; ++d) {
                values[n] *= powers[d][static_cast<std::size_t>(m_indices[n][d])];
            }
        }
    }

private:
    int m_order;
    std::vector<std::array<int, 4>> m_indices;
    std::vector<double> m_factors;
};

class BernsteinSimplex : public FiniteElement {
public:
    BernsteinSimplex(const Collection& collection, std::size_t dimension, const std::vector<Point>& nodes)
        : FiniteElement(nodes.size(), 1), m_dimension(dimension), m_functions(collection.order, dimension, nodes) {}
    void evaluate(const Point& x, double* values) const override { m_functions.evaluate(x, m_dimension, values); }

private:
    std::size_t m_dimension;
    Bernstein m_functions;
};

/** The functions of a spanning set's span that are dual to functionals. */
class DualElement : public FiniteElement {
public:
    DualElement(std::unique_ptr<const SpanningSet> set, const Functionals& dofs)
        : FiniteElement(dofs.size(), set->n_components()), m_set(std::move(set)) {
        const std::size_t n = dofs.size();
        if (n > max_dofs_of_inverse) {
            throw std::invalid_argument("elements of " + std::to_string(n) + " degrees of freedom are not supported, at most " +
                                        std::to_string(max_dofs_of_inverse) +
                                        " are in shapes that are neither hexahedra nor quadrilaterals");
        }
        if (m_set->size() != n) {
            throw std::logic_error("functionals and functions of an element differ in number");
        }
        // Row: functional, column: function of the set.
        Eigen::MatrixXd matrix(n, n);
        std::vector<double> values(n * n_components());
        for (std::size_t row = 0; row < n; ++row) {
            m_set->evaluate(dofs[row].node, values.data());
            for (std::size_t column = 0; column < n; ++column) {
                double product = n_components() == 1 ? values[column] : 0;
                for (std::size_t c = 0; c < n_components() && n_components() > 1; ++c) {
                    product += dofs[row].direction[c] * values[c * n + column];
                }
                matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) = product;
            }
        }
        m_inverse = matrix.inverse();
    }

    void evaluate(const Point& x, double* values) const override {
        const auto n = static_cast<Eigen::Index>(n_dofs());
        const auto rows = static_cast<Eigen::Index>(n_components());
        using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
        Rows of_set(rows, n);
        m_set->evaluate(x, of_set.data());
        Eigen::Map<Rows>(values, rows, n).noalias() = of_set * m_inverse;
    }

private:
    std::unique_ptr<const SpanningSet> m_set;
    /** Coefficients of shape function `column` in the set. */
    Eigen::MatrixXd m_inverse;
};

/** Triangle times segment, for scalar prisms. */
class PrismElement : public FiniteElement {
public:
    PrismElement(const Collection& collection, const Functionals& dofs)
        : FiniteElement(dofs.size(), 1), m_line(collection.basis, collection.order + 1) {
        std::vector<Point> nodes;
        for (const Functional& dof : dofs) {
            const auto is_same = [&](const Point& node) {
                return std::abs(node[0] - dof.node[0]) + std::abs(node[1] - dof.node[1]) < 1e-9;
            };
            const auto found = std::ranges::find_if(nodes, is_same);
            m_places.push_back({static_cast<std::size_t>(found - nodes.begin()), m_line.nearest(dof.node[2])});
            if (found == nodes.end()) {
                nodes.push_back(dof.node);
            }
        }
        if (collection.basis == Basis::positive) {
            m_bernstein = std::make_unique<Bernstein>(collection.order, 2, nodes);
        } else {
            Functionals on_triangle;
            for (const Point& node : nodes) {
                on_triangle.push_back({node, {}});
            }
            m_nodal = std::make_unique<DualElement>(make_triangle_set(collection.order), on_triangle);
        }
    }

    void evaluate(const Point& x, double* values) const override {
        std::array<double, max_order + 1> line;
        std::array<double, (max_order + 1) * (max_order + 2) / 2> triangle;
        m_line.evaluate(x[2], line.data());
        if (m_bernstein) {
            m_bernstein->evaluate(x, 2, triangle.data());
        } else {
            m_nodal->evaluate(x, triangle.data());
        }
        for (const auto& [in_triangle, in_line] : m_places) {
            *values++ = triangle[in_triangle] * line[in_line];
        }
    }

private:
    struct Place {
        std::size_t triangle;
        std::size_t line;
    };
    Basis1d m_line;
    std::vector<Place> m_places;
    std::unique_ptr<const Bernstein> m_bernstein;
    std::unique_ptr<const DualElement> m_nodal;
};

/** Throws for what MFEM 4.8 cannot write or what is not read here. */
void check_pyramid(const Collection& collection) {
    if (collection.is_vector()) {
        throw std::invalid_argument("Nedelec and Raviart-Thomas pyramids are not supported");
    }
    if (collection.order > 1 && collection.basis == Basis::positive) {
        throw std::invalid_argument("pyramids in Bernstein bases are not supported");
    }
    const bool is_closed = collection.basis == Basis::gauss_lobatto || collection.basis == Basis::closed_uniform;
    if (collection.family == Family::l2 && collection.order > 0 && (is_closed || collection.basis == Basis::positive)) {
        throw std::invalid_argument("L2 pyramids on closed points are not supported");
    }
}

} // namespace

std::unique_ptr<const FiniteElement> make_element(const Collection& collection, Geometry geometry) {
    if (geometry == Geometry::pyramid) {
        check_pyramid(collection);
    }
    if (collection.is_first_cubic && (geometry == Geometry::prism || geometry == Geometry::pyramid)) {
        throw std::invalid_argument("the collection 'Cubic' is not supported on prisms and pyramids");
    }
    const Functionals dofs = functionals(collection, geometry);
    std::vector<Point> nodes;
    for (const Functional& dof : dofs) {
        nodes.push_back(dof.node);
    }
    const auto n_axes = static_cast<std::size_t>(dimension(geometry));
    if (collection.is_vector()) {
        if (geometry == Geometry::cube || geometry == Geometry::square) {
            return std::make_unique<VectorTensorElement>(collection, n_axes, dofs);
        }
        return std::make_unique<DualElement>(make_vector_set(collection, geometry), dofs);
    }
    switch (geometry) {
    case Geometry::square:
    case Geometry::cube:
        return std::make_unique<TensorElement>(collection, geometry, dofs);
    case Geometry::prism:
        return std::make_unique<PrismElement>(collection, dofs);
    case Geometry::triangle:
    case Geometry::tetrahedron:
        if (collection.basis == Basis::positive) {
            return std::make_unique<BernsteinSimplex>(collection, n_axes, nodes);
        }
        return std::make_unique<DualElement>(
            n_axes == 2 ? make_triangle_set(collection.order) : make_tetrahedron_set(collection.order), dofs);
    default:
        if (collection.family == Family::l2) {
            return std::make_unique<TensorElement>(collection, geometry, dofs);
        }
        return std::make_unique<DualElement>(make_fuentes_set(collection.order), dofs);
    }
}

} // namespace elvis_mfem
