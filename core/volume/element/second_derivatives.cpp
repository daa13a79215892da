#include <core/volume/element/second_derivatives.hpp>

#include <Eigen/Dense>

#include <cassert>
#include <cmath>
#include <map>
#include <numbers>

namespace elvis {

namespace {

using Matrix = Eigen::MatrixXd;
/** Exponents of the barycentric coordinates; their sum is the degree. The first belongs to the corner (-1, .., -1). */
using Exponents = std::array<std::uint32_t, 4>;

/** All of one degree on a simplex. */
std::vector<Exponents> all_exponents(std::size_t dimension, std::uint32_t degree) {
    std::vector<Exponents> all;
    const std::uint32_t most_2 = dimension > 1 ? degree : 0, most_3 = dimension > 2 ? degree : 0;
    for (std::uint32_t c = 0; c <= most_3; ++c) {
        for (std::uint32_t b = 0; b + c <= degree && b <= most_2; ++b) {
            for (std::uint32_t a = 0; a + b + c <= degree; ++a) {
                all.push_back({degree - a - b - c, a, b, c});
            }
        }
    }
    return all;
}

std::size_t index_of(std::span<const Exponents> all, const Exponents& wanted) {
    return static_cast<std::size_t>(std::ranges::find(all, wanted) - all.begin());
}

Eigen::Index at(std::size_t index) { return static_cast<Eigen::Index>(index); }

/** The Bernstein polynomial degree! / prod a_i! prod lambda_i^a_i. */
double bernstein(const Exponents& exponents, std::span<const double> lambda) {
    double value = 1, n = 0;
    for (std::size_t i = 0; i < lambda.size(); ++i) {
        for (std::uint32_t k = 1; k <= exponents[i]; ++k) {
            value *= ++n / k * lambda[i];
        }
    }
    return value;
}

/** From coefficients of one degree to those of the derivative in a direction: lambda_i = (1 + xi_i)/2. */
Matrix differences(std::size_t dimension, std::uint32_t degree, std::size_t direction) {
    const std::vector<Exponents> from = all_exponents(dimension, degree);
    if (degree == 0) {
        return Matrix::Zero(1, 1);
    }
    const std::vector<Exponents> to = all_exponents(dimension, degree - 1);
    Matrix result = Matrix::Zero(at(to.size()), at(from.size()));
    for (std::size_t row = 0; row < to.size(); ++row) {
        Exponents upper = to[row], lower = to[row];
        ++upper[direction + 1];
        ++lower[0];
        result(at(row), at(index_of(from, upper))) = 0.5 * degree;
        result(at(row), at(index_of(from, lower))) = -0.5 * degree;
    }
    return result;
}

/** To the next degree. */
Matrix elevation(std::size_t dimension, std::uint32_t degree) {
    const std::vector<Exponents> from = all_exponents(dimension, degree), to = all_exponents(dimension, degree + 1);
    Matrix result = Matrix::Zero(at(to.size()), at(from.size()));
    for (std::size_t row = 0; row < to.size(); ++row) {
        for (std::size_t i = 0; i <= dimension; ++i) {
            if (to[row][i] > 0) {
                Exponents part = to[row];
                --part[i];
                result(at(row), at(index_of(from, part))) = static_cast<double>(to[row][i]) / (degree + 1);
            }
        }
    }
    return result;
}

} // namespace

/** A simplex, with a polynomial degree. */
struct SecondDerivatives::Factor {
    std::vector<std::size_t> directions;
    std::uint32_t degree;

    std::size_t dimension() const { return directions.size(); }
    std::size_t n_nodes() const { return all_exponents(dimension(), degree).size(); }

    /** Barycentric coordinates. On lines Chebyshev points with the ends; lattices elsewhere. */
    std::vector<double> node(const Exponents& exponents) const {
        std::vector<double> lambda(dimension() + 1, 1.0 / static_cast<double>(dimension() + 1));
        for (std::size_t i = 0; i < lambda.size() && degree > 0; ++i) {
            const double share = static_cast<double>(exponents[i]) / degree;
            lambda[i] = dimension() == 1 ? 0.5 - 0.5 * std::cos(std::numbers::pi * share) : share;
        }
        return lambda;
    }

    /** From values at nodes to coefficients. */
    Matrix interpolation() const {
        const std::vector<Exponents> all = all_exponents(dimension(), degree);
        Matrix values(at(all.size()), at(all.size()));
        for (std::size_t node_index = 0; node_index < all.size(); ++node_index) {
            const std::vector<double> lambda = node(all[node_index]);
            for (std::size_t term = 0; term < all.size(); ++term) {
                values(at(node_index), at(term)) = bernstein(all[term], lambda);
            }
        }
        return values.fullPivLu().inverse();
    }

    /** The derivative in these directions, raised to the factor's degree if the shape has others. */
    Matrix derivative(std::span<const std::size_t> in, bool is_raised) const {
        Matrix result = Matrix::Identity(at(n_nodes()), at(n_nodes()));
        std::uint32_t reached = degree;
        for (const std::size_t direction : in) {
            result = differences(dimension(), reached, direction) * result;
            reached -= reached > 0 ? 1 : 0;
        }
        for (; is_raised && reached < degree; ++reached) {
            result = elevation(dimension(), reached) * result;
        }
        return result;
    }
};

/** Makes steps, each partial result once. */
class SecondDerivatives::Planner {
public:
    Planner(SecondDerivatives& of, std::span<const Factor> factors) : m_of(of), m_factors(factors) {
        for (const Factor& factor : factors) {
            m_sizes.push_back(factor.n_nodes());
        }
        m_of.m_size = n_numbers();
    }

    void interpolate() {
        std::size_t source = 0;
        for (std::size_t factor = 0; factor < m_factors.size(); ++factor) {
            const Matrix map = m_factors[factor].interpolation();
            source = add(m_of.m_interpolation, map, factor, source, m_sizes);
        }
        m_of.m_polynomial_at = source;
    }

    void differentiate(std::size_t derivative, std::array<std::size_t, 2> directions) {
        std::vector<std::size_t> done, sizes = m_sizes;
        std::size_t source = m_of.m_polynomial_at;
        for (std::size_t factor = 0; factor < m_factors.size(); ++factor) {
            std::vector<std::size_t> in;
            for (const std::size_t direction : directions) {
                const auto& own = m_factors[factor].directions;
                const auto found = std::ranges::find(own, direction);
                if (found != own.end()) {
                    in.push_back(static_cast<std::size_t>(found - own.begin()));
                }
            }
            if (in.empty()) {
                continue;
            }
            const Matrix map = m_factors[factor].derivative(in, m_factors.size() > 1);
            for (const std::size_t direction : in) {
                done.push_back(m_factors[factor].directions[direction]);
            }
            const auto known = m_known.find(done);
            source = known != m_known.end() ? known->second : add(m_of.m_differentiation, map, factor, source, sizes);
            m_known[done] = source;
            sizes[factor] = static_cast<std::size_t>(map.rows());
        }
        m_of.m_derivatives_at[derivative] = source;
        m_of.m_n_coefficients = product(sizes);
    }

private:
    static std::size_t product(std::span<const std::size_t> sizes) {
        std::size_t result = 1;
        for (const std::size_t size : sizes) {
            result *= size;
        }
        return result;
    }
    std::size_t n_numbers() const { return product(m_sizes); }

    /** Returns where the result begins. */
    std::size_t add(std::vector<Step>& steps, const Matrix& matrix, std::size_t factor, std::size_t source,
                    std::span<const std::size_t> sizes) {
        Map map{static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols()), {}};
        for (std::size_t row = 0; row < map.n_rows; ++row) {
            for (std::size_t column = 0; column < map.n_columns; ++column) {
                if (matrix(at(row), at(column)) != 0) {
                    map.entries.push_back({row, column, matrix(at(row), at(column))});
                }
            }
        }
        const std::size_t n_before = product(sizes.first(factor)), n_after = product(sizes.subspan(factor + 1));
        const std::size_t target = m_of.m_size;
        m_of.m_size += n_before * map.n_rows * n_after;
        steps.push_back({m_of.m_maps.size(), source, target, n_before, n_after});
        m_of.m_maps.push_back(std::move(map));
        return target;
    }

    SecondDerivatives& m_of;
    std::span<const Factor> m_factors;
    std::vector<std::size_t> m_sizes;
    std::map<std::vector<std::size_t>, std::size_t> m_known;
};

SecondDerivatives::SecondDerivatives(elvis_shape shape, std::span<const std::uint32_t, 3> order) {
    assert(shape == ELVIS_SHAPE_HEXAHEDRON || shape == ELVIS_SHAPE_PRISM || shape == ELVIS_SHAPE_TETRAHEDRON);
    std::vector<Factor> factors;
    if (shape == ELVIS_SHAPE_HEXAHEDRON) {
        factors = {{{0}, order[0]}, {{1}, order[1]}, {{2}, order[2]}};
    } else if (shape == ELVIS_SHAPE_PRISM) {
        factors = {{{0, 2}, std::max(order[0], order[2])}, {{1}, order[1]}};
    } else {
        factors = {{{0, 1, 2}, std::max({order[0], order[1], order[2]})}};
    }
    place_nodes(factors);
    Planner planner(*this, factors);
    planner.interpolate();
    std::size_t derivative = 0;
    for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t k = j; k < 3; ++k) {
            planner.differentiate(derivative++, {j, k});
        }
    }
}

void SecondDerivatives::place_nodes(std::span<const Factor> factors) {
    /** A point of the factors up to here, and what the gradient at the centroid takes of one coefficient: value and
     * derivatives. */
    struct Partial {
        std::array<double, 3> xi;
        std::array<double, 4> weights;
    };
    std::vector<Partial> partials{{{}, {1, 0, 0, 0}}};
    for (const Factor& factor : factors) {
        const std::vector<Exponents> all = all_exponents(factor.dimension(), factor.degree);
        const std::vector<double> centroid(factor.dimension() + 1, 1.0 / static_cast<double>(factor.dimension() + 1));
        const auto derivative = [&](const Exponents& exponents, std::size_t direction) {
            double sum = 0;
            for (const auto& [i, slope] : {std::pair<std::size_t, double>{direction + 1, 0.5}, {0, -0.5}}) {
                if (exponents[i] > 0) {
                    Exponents lower = exponents;
                    --lower[i];
                    sum += slope * factor.degree * bernstein(lower, centroid);
                }
            }
            return sum;
        };
        std::vector<Partial> longer;
        for (const Partial& partial : partials) {
            for (const Exponents& exponents : all) {
                Partial next = partial;
                const double value = bernstein(exponents, centroid);
                const std::vector<double> lambda = factor.node(exponents);
                for (double& weight : next.weights) {
                    weight *= value;
                }
                for (std::size_t own = 0; own < factor.dimension(); ++own) {
                    next.xi[factor.directions[own]] = 2 * lambda[own + 1] - 1;
                    next.weights[factor.directions[own] + 1] = partial.weights[0] * derivative(exponents, own);
                }
                longer.push_back(next);
            }
        }
        partials = std::move(longer);
    }
    for (const Partial& partial : partials) {
        m_nodes.insert(m_nodes.end(), partial.xi.begin(), partial.xi.end());
        m_gradient_weights.insert(m_gradient_weights.end(), partial.weights.begin() + 1, partial.weights.end());
    }
}

} // namespace elvis
