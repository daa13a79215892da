#include "kind.hpp"

#include <plugins/nodal/nodal_space.hpp>

#include <algorithm>

namespace elvis_pyfr {

using elvis::native::Shape;

namespace {

constexpr std::array<Kind, 6> all_kinds = {{{"hex", Shape::hexahedron, 6, {0, 1, 2, 3, 4, 5}},
                                            {"pri", Shape::prism, 5, {3, 1, 0, 2, 4, -1}},
                                            {"pyr", Shape::pyramid, 5, {0, 1, 2, 3, 4, -1}},
                                            {"quad", Shape::quadrilateral, 4, {0, 1, 2, 3, -1, -1}},
                                            {"tet", Shape::tetrahedron, 4, {0, 1, 3, 2, -1, -1}},
                                            {"tri", Shape::triangle, 3, {0, 1, 2, -1, -1, -1}}}};

/** Nodes of hexahedra of order 12: their matrix is inverted in seconds. */
constexpr std::size_t most_nodes = 2197;
/** Pyramids of order n are contained in native ones of order 2n along xi3. */
constexpr std::uint32_t most_pyramid_order = elvis::native::max_order / 2;

/** Nodes of a layer, x and y from `low` to `high`; those with x + y beyond the layer's diagonal are left out of triangles. */
struct Layer {
    std::uint32_t n_intervals;
    bool is_triangle;
    double low, high;
};

void add_layer(const Kind& kind, const Layer& layer, double z, std::vector<double>& nodes) {
    const std::uint32_t n = layer.n_intervals;
    const auto at = [&](std::uint32_t i) {
        return n == 0 ? (layer.low + layer.high) / 2 : layer.low + (layer.high - layer.low) * i / n;
    };
    for (std::uint32_t j = 0; j <= n; ++j) {
        for (std::uint32_t i = 0; i <= (layer.is_triangle ? n - j : n); ++i) {
            const auto xi = to_native(kind, std::array{at(i), at(j), z});
            nodes.insert(nodes.end(), xi.begin(), xi.end());
        }
    }
}

} // namespace

std::span<const Kind> kinds() { return all_kinds; }

const Kind* find_kind(std::string_view name) {
    const auto found = std::ranges::find(all_kinds, name, &Kind::name);
    return found == all_kinds.end() ? nullptr : &*found;
}

std::uint32_t most_order(const Kind& kind) {
    std::uint32_t order = 1;
    while (order < (kind.shape == Shape::pyramid ? most_pyramid_order : elvis::native::max_order) &&
           elvis::nodal::n_functions(kind.shape, order + 1) <= most_nodes) {
        ++order;
    }
    return order;
}

std::array<double, 3> to_native(const Kind& kind, const std::array<double, 3>& x) {
    switch (kind.shape) {
    case Shape::prism:
        // The triangle of ElVis's prism lies in xi1 and xi3; the line is turned round to keep the orientation.
        return {x[0], -x[2], x[1]};
    case Shape::pyramid:
        // The apex stands above a corner.
        return {x[0] - (1 + x[2]) / 2, x[1] - (1 + x[2]) / 2, x[2]};
    default:
        return x;
    }
}

std::vector<double> to_native(const Kind& kind, std::span<const double> points) {
    const auto dimension = static_cast<std::size_t>(elvis::native::dimension(kind.shape));
    std::vector<double> all;
    for (std::size_t first = 0; first + dimension <= points.size(); first += dimension) {
        std::array<double, 3> x{};
        std::copy_n(&points[first], dimension, x.begin());
        const auto xi = to_native(kind, x);
        all.insert(all.end(), xi.begin(), xi.end());
    }
    return all;
}

std::vector<double> shape_nodes(const Kind& kind, std::uint32_t order) {
    const bool is_flat = elvis::native::dimension(kind.shape) == 2;
    std::vector<double> nodes;
    for (std::uint32_t k = 0; k <= (is_flat ? 0 : order); ++k) {
        const double z = -1 + 2.0 * k / order;
        switch (kind.shape) {
        case Shape::hexahedron:
        case Shape::prism:
            add_layer(kind, {order, kind.shape == Shape::prism, -1, 1}, z, nodes);
            break;
        case Shape::pyramid:
            add_layer(kind, {order - k, false, -(1 - z) / 2, (1 - z) / 2}, z, nodes);
            break;
        case Shape::tetrahedron:
            add_layer(kind, {order - k, true, -1, -z}, z, nodes);
            break;
        default:
            add_layer(kind, {order, kind.shape == Shape::triangle, -1, 1}, 0, nodes);
        }
    }
    return nodes;
}

} // namespace elvis_pyfr
