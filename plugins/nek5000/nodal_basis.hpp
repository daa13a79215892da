/**
 * @file nodal_basis.hpp
 * Lagrange polynomials through nodes on [-1, 1].
 */
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

namespace elvis_nek5000 {

enum class NodeFamily : std::uint8_t { gauss_lobatto, gauss, equidistant };

/** Products of nodes in two or three directions; the third has one node in two dimensions. */
struct NodeSet {
    std::array<std::uint32_t, 3> n{};
    NodeFamily family = NodeFamily::gauss_lobatto;

    bool operator==(const NodeSet&) const = default;
    bool operator<(const NodeSet& other) const { return std::tie(n, family) < std::tie(other.n, other.family); }
    std::size_t size() const { return std::size_t{n[0]} * n[1] * n[2]; }
};

/** Ascending. A single one lies in the middle. */
std::vector<double> nodes(NodeFamily family, std::uint32_t n);

/** Values of all polynomials at x: exactly 0 and 1 at nodes. */
void evaluate_lagrange(std::span<const double> nodes, double x, std::span<double> values);

} // namespace elvis_nek5000
