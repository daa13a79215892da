// Which spaces exist, and how large they are.
#include "../file/runs.hpp"

#include <stdexcept>
#include <string>

namespace elvis::native {

void check(const Space& space) {
    const auto refuse = [&](const std::string& reason) {
        throw std::invalid_argument("space " + std::string(name(space.shape)) + "/" + std::string(name(space.basis)) +
                                    " of order (" + std::to_string(space.order[0]) + ", " + std::to_string(space.order[1]) +
                                    ", " + std::to_string(space.order[2]) + "): " + reason);
    };
    if (space.shape > Shape::triangle)
        refuse("unknown shape " + std::to_string(static_cast<std::uint32_t>(space.shape)));
    if (space.basis > Basis::tensor)
        refuse("unknown basis " + std::to_string(static_cast<std::uint32_t>(space.basis)));
    for (std::uint32_t order : space.order)
        if (order > max_order)
            refuse("the largest order is " + std::to_string(max_order));
    const bool planar = dimension(space.shape) == 2;
    if (planar && space.order[2] != 0)
        refuse("a two-dimensional shape has no third order");
    const bool cube = space.shape == Shape::hexahedron || space.shape == Shape::quadrilateral;
    if ((space.basis == Basis::gll_lagrange || space.basis == Basis::gauss_lagrange) && !cube)
        refuse("Lagrange bases exist on hexahedra and quadrilaterals only");
    if (space.basis == Basis::tensor && space.shape != Shape::pyramid)
        refuse("the tensor basis exists on pyramids only");
    if (is_constant(space))
        return;
    const auto [p, q, r] = space.order;
    if (p == 0 || q == 0 || (!planar && r == 0))
        refuse("order 0 in one direction asks for order 0 in all");
    // The truncations q <= Q - p and r <= R - p - q would cut off modes of the faces otherwise.
    if (space.shape == Shape::triangle && p > q)
        refuse("a triangle needs order 1 <= order 2");
    if (space.shape == Shape::prism && p > r)
        refuse("a prism needs order 1 <= order 3");
    if (space.shape == Shape::tetrahedron && (p > q || q > r))
        refuse("a tetrahedron needs order 1 <= order 2 <= order 3");
    if (space.shape == Shape::pyramid && space.basis != Basis::tensor && (p != q || q != r))
        refuse("this basis of a pyramid needs equal orders");
}

std::size_t n_modes(const Space& space) {
    std::size_t n = 0;
    for_each_run(space, [&n](const Run& run) { n += static_cast<std::size_t>(run.count); });
    return n;
}

std::array<std::uint32_t, 3> collapsed_order(const Space& space) {
    std::array<std::uint32_t, 3> result{};
    const Directions axis = directions(space.shape);
    const auto include = [&](std::size_t direction, const Factor& factor) {
        const int value = degree(factor, space.order[direction]);
        result[direction] = std::max(result[direction], static_cast<std::uint32_t>(value));
    };
    for_each_run(space, [&](const Run& run) {
        include(axis.outer, run.outer);
        include(axis.mid, run.mid);
        Factor last = run.inner;
        last.index += run.count - 1;
        include(axis.inner, last);
    });
    return result;
}

} // namespace elvis::native
