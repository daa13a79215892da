#include "base.hpp"

#include <algorithm>

namespace elvis_cgns {

namespace {

/** Elements and corners have numbers below this in a volume. */
constexpr std::uint64_t most_vertices = (std::uint64_t{1} << 32) - 2;

Base describe(const Node& node) {
    const std::vector<std::int64_t> dimensions = integers(node);
    if (dimensions.size() != 2 || dimensions[0] < 1 || dimensions[0] > 3 || dimensions[1] < dimensions[0] ||
        dimensions[1] > 3) {
        node.fail("does not say how many dimensions its cells and its space have");
    }
    return {node, static_cast<std::uint32_t>(dimensions[0]), static_cast<std::uint32_t>(dimensions[1]), {}};
}

std::uint64_t extent(const Node& node, std::int64_t number) {
    if (number < 1 || static_cast<std::uint64_t>(number) > most_vertices) {
        node.fail("says that it has " + std::to_string(number) + " vertices or cells");
    }
    return static_cast<std::uint64_t>(number);
}

Zone read_zone(Tree& tree, const Node& node, const Base& base) {
    Zone zone;
    zone.node = node;
    const auto type = tree.child(node, "ZoneType_t");
    const std::string kind = type ? text(*type) : "Structured";
    if (kind != "Structured" && kind != "Unstructured") {
        node.fail("is of the type '" + kind + "', neither Structured nor Unstructured");
    }
    zone.is_structured = kind == "Structured";
    zone.n_indices = zone.is_structured ? base.dimension : 1;
    const std::vector<std::int64_t> sizes = integers(node);
    if (sizes.size() < 2 * zone.n_indices) {
        node.fail("does not say how many vertices and cells it has");
    }
    for (std::size_t index = 0; index < zone.n_indices; ++index) {
        zone.n_vertices[index] = extent(node, sizes[index]);
        zone.n_cells[index] = extent(node, sizes[zone.n_indices + index]);
        if (zone.is_structured && zone.n_cells[index] + 1 != zone.n_vertices[index]) {
            node.fail("says that it has " + std::to_string(zone.n_cells[index]) + " cells between " +
                      std::to_string(zone.n_vertices[index]) + " vertices");
        }
    }
    std::uint64_t n_vertices = 1;
    for (const std::uint64_t along : zone.n_vertices) {
        if (along > most_vertices / n_vertices) {
            node.fail("says that it has more vertices than can be read");
        }
        n_vertices *= along;
    }
    return zone;
}

/** Planes before and after those of the grid, for each index. */
std::vector<std::int64_t> rind(Tree& tree, const Node& parent, const Zone& zone) {
    const auto node = tree.child(parent, "Rind_t");
    std::vector<std::int64_t> planes = node ? integers(*node) : std::vector<std::int64_t>(2 * zone.n_indices, 0);
    if (planes.size() != 2 * zone.n_indices ||
        std::ranges::any_of(planes, [](std::int64_t n) { return n < 0 || static_cast<std::uint64_t>(n) > most_vertices; })) {
        node->fail("does not say how many planes there are on each side");
    }
    if (!zone.is_structured && std::ranges::any_of(planes, [](std::int64_t n) { return n != 0; })) {
        node->fail("is of an unstructured zone: such rinds are not read");
    }
    return planes;
}

} // namespace

Base read_base(Tree& tree, const elvis::api::Host& host) {
    std::vector<Base> bases;
    for (const Node& node : tree.children(tree.root(), "CGNSBase_t")) {
        bases.push_back(describe(node));
    }
    if (bases.empty()) {
        tree.root().fail("has no CGNSBase_t");
    }
    const auto chosen = std::ranges::max_element(bases, {}, &Base::dimension);
    if (bases.size() > 1) {
        std::string others;
        for (const Base& base : bases) {
            others += base.node.name == chosen->node.name ? "" : (others.empty() ? "" : ", ") + base.node.name;
        }
        host.log(ELVIS_LOG_WARNING, tree.path() + ": the base " + chosen->node.name + " is read; left out: " + others);
    }
    Base base = *chosen;
    if (base.dimension < 2) {
        base.node.fail("has cells of one dimension: lines are not read");
    }
    for (const char* const label : {"ElementInterpolation_t", "SolutionInterpolation_t"}) {
        for (const Node& family : tree.children(base.node, "Family_t")) {
            if (const auto found = tree.child(family, label)) {
                found->fail("gives own interpolation functions (CPEX 0045), which are not read");
            }
        }
    }
    for (const Node& node : tree.children(base.node, "Zone_t")) {
        base.zones.push_back(read_zone(tree, node, base));
    }
    if (base.zones.empty()) {
        base.node.fail("has no Zone_t");
    }
    return base;
}

std::string grid_location(Tree& tree, const Node& node) {
    const auto found = tree.child(node, "GridLocation_t");
    return found ? text(*found) : "Vertex";
}

std::vector<double> read_array(Tree& tree, const Node& parent, const Node& array, const Zone& zone,
                               const std::array<std::uint64_t, 3>& extents) {
    const std::vector<std::int64_t> planes = rind(tree, parent, zone);
    std::array<std::uint64_t, 3> all = extents, before{};
    std::uint64_t n_all = 1, n = 1;
    for (std::size_t index = 0; index < 3; ++index) {
        if (index < zone.n_indices) {
            before[index] = static_cast<std::uint64_t>(planes[2 * index]);
            all[index] += before[index] + static_cast<std::uint64_t>(planes[2 * index + 1]);
        }
        n *= extents[index];
        // Above this it is not the size of the array, whatever the product would be.
        n_all = all[index] > (std::uint64_t{1} << 60) / n_all ? 0 : n_all * all[index];
        n_all = std::max<std::uint64_t>(n_all, 1);
    }
    if (array.size() != n_all) {
        array.fail("has " + std::to_string(array.size()) + " numbers where its zone needs " + std::to_string(n_all));
    }
    std::vector<double> values = numbers(array);
    if (n == n_all) {
        return values;
    }
    std::vector<double> core;
    core.reserve(n);
    for (std::uint64_t k = 0; k < extents[2]; ++k) {
        for (std::uint64_t j = 0; j < extents[1]; ++j) {
            const std::uint64_t from = before[0] + all[0] * (before[1] + j + all[1] * (before[2] + k));
            const auto first = values.begin() + static_cast<std::ptrdiff_t>(from);
            core.insert(core.end(), first, first + static_cast<std::ptrdiff_t>(extents[0]));
        }
    }
    return core;
}

std::uint32_t mantissa_bits(const Node& array) { return array.type == "R4" ? 24 : 53; }

} // namespace elvis_cgns
