#include "cell_edges.hpp"

#include "node_order.hpp"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <utility>

namespace elvis_vtk {

namespace {

using Edge = std::pair<std::size_t, std::size_t>;

std::span<const Edge> edges_of(elvis_shape shape) {
    static constexpr Edge hexahedron[] = {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {4, 5}, {5, 6},
                                          {7, 6}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
    static constexpr Edge wedge[] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
    static constexpr Edge tetrahedron[] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
    switch (shape) {
    case ELVIS_SHAPE_HEXAHEDRON:
        return hexahedron;
    case ELVIS_SHAPE_QUADRILATERAL:
        return std::span(hexahedron).first(4);
    case ELVIS_SHAPE_PRISM:
        return wedge;
    case ELVIS_SHAPE_TETRAHEDRON:
        return tetrahedron;
    case ELVIS_SHAPE_TRIANGLE:
        return std::span(tetrahedron).first(3);
    default:
        return {};
    }
}

} // namespace

std::vector<std::vector<std::size_t>> edge_nodes(const CellKind& kind) {
    const std::vector<LatticePoint> nodes = lattice_nodes(kind);
    std::vector<std::vector<std::size_t>> edges;
    for (const auto& [from, to] : edges_of(kind.shape)) {
        const LatticePoint &a = nodes[from], &b = nodes[to];
        const LatticePoint whole{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
        const int n = std::max({std::abs(whole[0]), std::abs(whole[1]), std::abs(whole[2])});
        std::vector<std::size_t>& edge = edges.emplace_back();
        for (int i = 0; i <= n; ++i) {
            const LatticePoint at{a[0] + i * whole[0] / n, a[1] + i * whole[1] / n, a[2] + i * whole[2] / n};
            edge.push_back(static_cast<std::size_t>(std::ranges::find(nodes, at) - nodes.begin()));
        }
    }
    return edges;
}

} // namespace elvis_vtk
