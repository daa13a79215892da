#include "scheme.hpp"

#include <algorithm>
#include <cmath>

namespace gmsh {

namespace {

/** Orders of the smallest native space that contains the monomials. */
std::array<std::uint32_t, 3> native_order(Topology topology, const std::vector<std::array<int, 3>>& exponents) {
    std::array<int, 3> order{};
    for (const auto& [a, b, c] : exponents) {
        std::array<int, 3> needed{a, b, c};
        switch (topology) {
        case Topology::triangle:
        case Topology::tetrahedron:
            needed.fill(a + b + c);
            break;
        case Topology::prism:
            // The triangle lies in the first and third native axes.
            needed = {a + b, c, a + b};
            break;
        case Topology::pyramid:
            needed.fill(std::max(a, b) + c);
            break;
        default:
            break;
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            order[axis] = std::max(order[axis], needed[axis]);
        }
    }
    // Native spaces have order 0 in all directions or in none.
    const int least = std::max({order[0], order[1], order[2]}) > 0 ? 1 : 0;
    const auto of = [&](std::size_t axis) { return static_cast<std::uint32_t>(std::max(order[axis], least)); };
    return {of(0), of(1), dimension(topology) == 3 ? of(2) : 0};
}

class SchemeBasis final : public Basis {
public:
    SchemeBasis(Topology topology, Eigen::MatrixXd coefficients, std::vector<std::array<int, 3>> exponents)
        : m_coefficients(std::move(coefficients)), m_exponents(std::move(exponents)) {
        describe(topology, static_cast<std::size_t>(m_coefficients.rows()), gmsh::native_order(topology, m_exponents));
    }

private:
    Eigen::MatrixXd evaluate(const Eigen::Matrix3Xd& points) const override {
        Eigen::MatrixXd monomials(points.cols(), m_coefficients.cols());
        for (Eigen::Index point = 0; point < points.cols(); ++point) {
            double u = points(0, point), v = points(1, point);
            const double w = points(2, point), rest = 1 - w;
            if (topology() == Topology::pyramid) {
                u = rest != 0 ? u / rest : 0;
                v = rest != 0 ? v / rest : 0;
            }
            for (std::size_t index = 0; index < m_exponents.size(); ++index) {
                const auto [a, b, c] = m_exponents[index];
                double value = std::pow(u, a) * std::pow(v, b) * std::pow(w, c);
                if (topology() == Topology::pyramid) {
                    value *= std::pow(rest, std::max(a, b));
                }
                monomials(point, static_cast<Eigen::Index>(index)) = value;
            }
        }
        return monomials * m_coefficients.transpose();
    }

    Eigen::MatrixXd m_coefficients;
    std::vector<std::array<int, 3>> m_exponents;
};

} // namespace

std::unique_ptr<Basis> scheme_basis(Topology topology, Eigen::MatrixXd coefficients,
                                    std::vector<std::array<int, 3>> exponents) {
    return std::make_unique<SchemeBasis>(topology, std::move(coefficients), std::move(exponents));
}

} // namespace gmsh
