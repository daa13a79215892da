#include "line_nodes.hpp"

#include <elvis/native/space.hpp>

#include <cmath>
#include <numbers>

namespace elvis_hopr {

std::vector<double> equidistant_nodes(std::uint32_t order) {
    std::vector<double> nodes;
    for (std::uint32_t i = 0; i <= order; ++i) {
        nodes.push_back(order == 0 ? 0 : -1 + 2.0 * i / order);
    }
    return nodes;
}

std::vector<double> line_nodes(const std::string& type, std::uint32_t order) {
    std::vector<double> nodes(order + 1, 0.0), weights(order + 1);
    if (type == "GAUSS") {
        elvis::native::gauss_legendre(nodes, weights);
        return nodes;
    }
    // Those that contain the ends have at least two.
    if (order > 0 && type == "GAUSS-LOBATTO") {
        elvis::native::gauss_lobatto_legendre(nodes);
        return nodes;
    }
    if (order > 0 && type == "CHEBYSHEV-GAUSS-LOBATTO") {
        for (std::uint32_t i = 0; i <= order; ++i) {
            nodes[i] = -std::cos(std::numbers::pi * i / order);
        }
        return nodes;
    }
    return {};
}

std::vector<double> cube_of(const std::vector<double>& line) {
    std::vector<double> nodes;
    for (const double z : line) {
        for (const double y : line) {
            for (const double x : line) {
                nodes.insert(nodes.end(), {x, y, z});
            }
        }
    }
    return nodes;
}

} // namespace elvis_hopr
