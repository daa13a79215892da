#include "nodal_basis.hpp"

#include <elvis/native/space.hpp>

namespace elvis_nek5000 {

std::vector<double> nodes(NodeFamily family, std::uint32_t n) {
    std::vector<double> points(n);
    if (n == 1) {
        return points;
    }
    if (family == NodeFamily::gauss_lobatto) {
        elvis::native::gauss_lobatto_legendre(points);
    } else if (family == NodeFamily::gauss) {
        std::vector<double> weights(n);
        elvis::native::gauss_legendre(points, weights);
    } else {
        for (std::uint32_t i = 0; i < n; ++i) {
            points[i] = -1 + 2.0 * i / (n - 1);
        }
    }
    return points;
}

void evaluate_lagrange(std::span<const double> nodes, double x, std::span<double> values) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        double value = 1;
        for (std::size_t j = 0; j < nodes.size(); ++j) {
            value *= j == i ? 1 : (x - nodes[j]) / (nodes[i] - nodes[j]);
        }
        values[i] = value;
    }
}

} // namespace elvis_nek5000
