#include "block_type.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <stdexcept>
#include <vector>

namespace elvis_exodus {

namespace {

using enum Topology;
using elvis_cgns::Nodes;

struct Family {
    const char* begins;
    Topology topology;
};

/** Longer names first: one may begin with another. */
constexpr Family families[] = {{"TRISHELL", triangle},  {"HEX", hexahedron}, {"TET", tetrahedron}, {"WEDGE", prism},
                               {"PRISM", prism},        {"PENTA", prism},    {"PYR", pyramid},     {"SHELL", quadrilateral},
                               {"QUAD", quadrilateral}, {"TRI", triangle},   {"BAR", line},        {"BEAM", line},
                               {"TRUSS", line},         {"EDGE", line},      {"ROD", line},        {"CIRCLE", node},
                               {"SPHERE", node},        {"POINT", node}};

/** By number of nodes; the corners alone are of order 1. */
const std::map<std::pair<Topology, std::size_t>, ElementType>& types() {
    static const std::map<std::pair<Topology, std::size_t>, ElementType> all = [] {
        std::map<std::pair<Topology, std::size_t>, ElementType> types;
        for (const Topology topology : {triangle, quadrilateral, tetrahedron, pyramid, prism, hexahedron}) {
            for (const ElementType& type :
                 {ElementType{topology, 1, Nodes::all}, {topology, 2, Nodes::of_edges}, {topology, 2, Nodes::all}}) {
                types.try_emplace({topology, elvis_cgns::n_nodes(type)}, type);
            }
        }
        return types;
    }();
    return all;
}

} // namespace

ElementType block_type(const std::string& name, std::size_t n_nodes) {
    std::string upper = name;
    std::ranges::transform(upper, upper.begin(), [](unsigned char letter) { return static_cast<char>(std::toupper(letter)); });
    const auto* const family =
        std::ranges::find_if(families, [&](const Family& each) { return upper.starts_with(each.begins); });
    // A triangle may be called a shell.
    const auto found = [&](Topology topology) { return types().find({topology, n_nodes}); };
    if (family == std::end(families)) {
        throw std::invalid_argument("elements of type '" + name + "' are not read");
    }
    if (family->topology == node || family->topology == line) {
        return {family->topology, 1, Nodes::all};
    }
    const bool is_triangle = family->topology == quadrilateral && (n_nodes == 3 || n_nodes == 6);
    const auto type = found(is_triangle ? triangle : family->topology);
    if (type == types().end()) {
        throw std::invalid_argument("elements of type '" + name + "' with " + std::to_string(n_nodes) + " nodes are not read");
    }
    return type->second;
}

std::span<const int> node_order(const ElementType& type) {
    // Corners and edges, then faces of CGNS: bottom, front, right, back, left, top, and the middle. Exodus: the middle, bottom,
    // top, left, right, front, back.
    static constexpr std::array<int, 27> hexahedron_27{0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 12, 13,
                                                       14, 15, 16, 17, 18, 19, 21, 25, 24, 26, 23, 22, 20};
    const bool is_other = type == ElementType{hexahedron, 2, Nodes::all};
    return is_other ? std::span<const int>(hexahedron_27) : std::span<const int>();
}

std::span<const int> side_corners(Topology topology, std::int64_t side) {
    using Sides = std::vector<std::vector<int>>;
    static const std::map<Topology, Sides> sides = {
        {triangle, {{0, 1}, {1, 2}, {2, 0}}},
        {quadrilateral, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
        {tetrahedron, {{0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 2, 1}}},
        {pyramid, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {0, 4, 3}, {0, 3, 2, 1}}},
        {prism, {{0, 1, 4, 3}, {1, 2, 5, 4}, {0, 3, 5, 2}, {0, 2, 1}, {3, 4, 5}}},
        {hexahedron, {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {0, 4, 7, 3}, {0, 3, 2, 1}, {4, 5, 6, 7}}}};
    const auto found = sides.find(topology);
    if (found == sides.end() || side < 1 || side > static_cast<std::int64_t>(found->second.size())) {
        return {};
    }
    return found->second[static_cast<std::size_t>(side - 1)];
}

} // namespace elvis_exodus
