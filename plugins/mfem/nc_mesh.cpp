/**
 * @file nc_mesh.cpp
 * Nonconforming meshes: trees of refined elements, of which the mesh is the leaves. Order of the leaves and of their vertices
 * as in MFEM's NCMesh::UpdateLeafElements and UpdateVertices, since 4.3; see format.md.
 */
#include "mesh.hpp"
#include "text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elvis_mfem {

namespace {

constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();

struct TreeElement {
    int attribute = 1;
    Geometry geometry = Geometry::cube;
    int refinement = 0;
    bool is_used = false;
    bool has_parent = false;
    /** Nodes of a leaf, children of another; pyramids have up to ten. */
    std::vector<std::int32_t> items;
};

/** A node in the middle between two others, or with coordinates of its own. */
struct TreeNode {
    std::int32_t first = -1;
    std::int32_t second = -1;
    /** Weight of the second. */
    double scale = 0.5;
};

struct Tree {
    int dimension = 3;
    int space_dimension = 3;
    std::vector<TreeElement> elements;
    std::vector<BoundaryElement> boundary;
    std::vector<TreeNode> nodes;
    std::vector<int> root_states;
    /** Three numbers a node. */
    std::vector<double> coordinates;
};

int n_children(const TreeElement& element) {
    constexpr std::array<int, 8> of_type{0, 2, 2, 4, 2, 4, 4, 8};
    const bool is_pyramid = element.geometry == Geometry::pyramid;
    return is_pyramid && element.refinement == 7 ? 10 : of_type[static_cast<std::size_t>(element.refinement)];
}

void read_elements(Text& text, Tree& tree) {
    text.expect("elements");
    tree.elements.resize(text.count("the number of elements", 8));
    const auto n_elements = static_cast<std::int64_t>(tree.elements.size());
    for (std::size_t index = 0; index < tree.elements.size(); ++index) {
        TreeElement& element = tree.elements[index];
        const auto rank = text.integer("a rank", -1, most);
        element.attribute = static_cast<int>(text.integer("an attribute", 0, most));
        if (text.peek() == "-1") {
            // A free place in MFEM's table.
            text.word("a geometry");
            continue;
        }
        element.is_used = true;
        element.geometry = read_geometry(text, tree.dimension);
        element.refinement = static_cast<int>(text.integer("a type of refinement", 0, 7));
        if (element.refinement == 0) {
            if (rank > 0) {
                text.fail("this is a part of a parallel mesh, which is not supported");
            }
            for (std::size_t node = 0; node < vertices(element.geometry).size(); ++node) {
                element.items.push_back(static_cast<std::int32_t>(text.integer("a node", 0, most)));
            }
        } else {
            for (int child = 0; child < n_children(element); ++child) {
                // -1: a child that this refinement of a tetrahedron or pyramid does not have.
                const auto number = text.integer("a child", -1, n_elements - 1);
                if (number < 0) {
                    continue;
                }
                TreeElement& target = tree.elements[static_cast<std::size_t>(number)];
                if (target.has_parent || static_cast<std::size_t>(number) == index) {
                    text.fail("element " + std::to_string(number) + " has two parents");
                }
                target.has_parent = true;
                element.items.push_back(static_cast<std::int32_t>(number));
            }
        }
    }
}

void read_parents(Text& text, Tree& tree, bool has_scales) {
    const std::size_t n = text.count("the number of vertices with parents", 6);
    const std::int64_t limit = static_cast<std::int64_t>(text.left());
    for (std::size_t index = 0; index < n; ++index) {
        // Numbers of nodes are dense: more of them than bytes cannot be.
        const auto node = static_cast<std::size_t>(text.integer("a vertex", 0, limit));
        if (node >= tree.nodes.size()) {
            tree.nodes.resize(node + 1);
        }
        TreeNode parents;
        parents.first = static_cast<std::int32_t>(text.integer("a parent", 0, limit));
        parents.second = static_cast<std::int32_t>(text.integer("a parent", 0, limit));
        if (has_scales) {
            parents.scale = text.real("a scale");
        }
        tree.nodes[node] = parents;
    }
}

/** The corner beyond an axis (1, 2, 4) of a hexahedron, both in MFEM's numbering. */
int corner_across(int corner, int axis) {
    // Numbering to bits of x, y, z and back: only 2 and 3, 6 and 7 change places.
    const auto swap = [](int c) { return c ^ ((c >> 1) & 1); };
    return swap(swap(corner) ^ axis);
}

/**
 * The three axes of a Hilbert curve through a hexahedron's children that begins at corner state / 3. The three curves of a
 * corner are the cyclic orders of the axes, sorted by the corner that comes second.
 */
std::array<int, 3> curve_axes(int state) {
    std::array<std::array<int, 3>, 3> curves{{{1, 2, 4}, {2, 4, 1}, {4, 1, 2}}};
    const int corner = state / 3;
    std::ranges::sort(curves, {}, [&](const auto& axes) { return corner_across(corner, axes[0]); });
    return curves[static_cast<std::size_t>(state % 3)];
}

int curve_state(int corner, const std::array<int, 3>& axes) {
    int state = 3 * corner;
    while (curve_axes(state) != axes) {
        ++state;
    }
    return state;
}

struct Step {
    int child;
    int state;
};

/** Children of a refined square along its curve, which begins at corner state / 2 and goes round forward if state is even. */
std::vector<Step> square_curve(int state) {
    const int back = state ^ 1;
    const int corner = state / 2, step = state % 2 == 0 ? 1 : 3;
    return {{corner, back}, {(corner + step) % 4, state}, {(corner + 2) % 4, state}, {(corner + 3 * step) % 4, (back + 4) % 8}};
}

/** Children of a refined hexahedron along the curve, and the curves inside them. */
std::vector<Step> cube_curve(int state) {
    const auto [a, b, c] = curve_axes(state);
    const auto at = [&, corner = state / 3](int x) {
        int result = corner;
        for (int axis : {1, 2, 4}) {
            result = (x & axis) != 0 ? corner_across(result, axis) : result;
        }
        return result;
    };
    const int first = curve_state(at(0), {b, c, a});
    const int second = curve_state(at(0), {c, a, b});
    const int middle = curve_state(at(a | b), {a, b, c});
    const int late = curve_state(at(b | c), {c, a, b});
    const int last = curve_state(at(a | c), {b, c, a});
    return {{at(0), first},      {at(a), second},       {at(a | b), second}, {at(b), middle},
            {at(b | c), middle}, {at(a | b | c), late}, {at(a | c), late},   {at(c), last}};
}

/** Children in MFEM's order; the state passes through where they follow no curve. */
std::vector<Step> steps(const TreeElement& element, int state) {
    if (element.geometry == Geometry::cube && element.items.size() == 8) {
        return cube_curve(state);
    }
    if (element.geometry == Geometry::square && element.items.size() == 4) {
        return square_curve(state);
    }
    std::vector<Step> result;
    for (int child = 0; child < static_cast<int>(element.items.size()); ++child) {
        result.push_back({child, state});
    }
    return result;
}

/** Numbers of the leaves, in MFEM's order. */
std::vector<std::size_t> collect_leaves(const Text& text, const Tree& tree) {
    std::vector<std::size_t> roots;
    for (std::size_t index = 0; index < tree.elements.size(); ++index) {
        if (tree.elements[index].is_used && !tree.elements[index].has_parent) {
            roots.push_back(index);
        }
    }
    struct Item {
        std::size_t element;
        int state;
    };
    std::vector<std::size_t> leaves;
    std::vector<Item> stack;
    std::size_t n_visited = 0;
    for (std::size_t root = 0; root < roots.size(); ++root) {
        stack.push_back({roots[root], root < tree.root_states.size() ? tree.root_states[root] : 0});
        while (!stack.empty()) {
            const auto [number, state] = stack.back();
            stack.pop_back();
            ++n_visited;
            const TreeElement& element = tree.elements[number];
            if (element.refinement == 0) {
                if (element.is_used) {
                    leaves.push_back(number);
                }
                continue;
            }
            const std::vector<Step> order = steps(element, state);
            for (auto step = order.rbegin(); step != order.rend(); ++step) {
                const auto child = element.items[static_cast<std::size_t>(step->child)];
                stack.push_back({static_cast<std::size_t>(child), step->state});
            }
        }
    }
    const auto n_used = std::ranges::count_if(tree.elements, &TreeElement::is_used);
    if (n_visited < static_cast<std::size_t>(n_used)) {
        text.fail("the tree of elements has a cycle");
    }
    return leaves;
}

/** Positions of all nodes; NaN for those that have none. */
std::vector<Point> positions(const Text& text, const Tree& tree) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    const std::size_t n_top = tree.coordinates.size() / 3;
    std::vector<Point> result(std::max(n_top, tree.nodes.size()), Point{unknown, unknown, unknown});
    enum class Mark : char { none, open, done };
    std::vector<Mark> marks(result.size(), Mark::none);
    for (std::size_t node = 0; node < n_top; ++node) {
        std::copy_n(tree.coordinates.begin() + static_cast<std::ptrdiff_t>(3 * node), 3, result[node].begin());
        marks[node] = Mark::done;
    }
    std::vector<std::size_t> stack;
    for (std::size_t start = 0; start < tree.nodes.size(); ++start) {
        stack.push_back(start);
        while (!stack.empty()) {
            const std::size_t node = stack.back();
            const TreeNode& parents = tree.nodes[node];
            if (marks[node] == Mark::done || parents.first < 0) {
                stack.pop_back();
                continue;
            }
            const std::array ends{static_cast<std::size_t>(parents.first), static_cast<std::size_t>(parents.second)};
            if (std::max(ends[0], ends[1]) >= result.size()) {
                text.fail("vertex " + std::to_string(node) + " has a parent that does not exist");
            }
            bool is_ready = true;
            for (std::size_t end : ends) {
                if (marks[end] == Mark::none && tree.nodes.size() > end && tree.nodes[end].first >= 0) {
                    stack.push_back(end);
                    is_ready = false;
                } else if (marks[end] == Mark::open) {
                    text.fail("vertex " + std::to_string(end) + " is its own ancestor");
                }
            }
            marks[node] = is_ready ? Mark::done : Mark::open;
            if (is_ready) {
                for (std::size_t d = 0; d < 3; ++d) {
                    result[node][d] = (1 - parents.scale) * result[ends[0]][d] + parents.scale * result[ends[1]][d];
                }
                stack.pop_back();
            }
        }
    }
    return result;
}

/** `vertex_of` a node, or -1. */
void add_boundary(const Tree& tree, std::span<const std::int32_t> vertex_of, Mesh& mesh) {
    for (BoundaryElement element : tree.boundary) {
        bool is_known = true;
        for (std::int32_t& vertex : element.vertices) {
            if (vertex >= 0) {
                const auto node = static_cast<std::size_t>(vertex);
                vertex = node < vertex_of.size() ? vertex_of[node] : -1;
                is_known = is_known && vertex >= 0;
            }
        }
        // Faces of refined elements may be listed beside those of their children.
        if (is_known) {
            mesh.boundary.push_back(element);
        }
    }
}

void add_coordinates(const Text& text, const Tree& tree, std::span<const std::int32_t> vertex_of, Mesh& mesh) {
    const std::vector<Point> at = positions(text, tree);
    mesh.coordinates.resize(3 * mesh.n_vertices);
    for (std::size_t node = 0; node < vertex_of.size(); ++node) {
        if (vertex_of[node] < 0) {
            continue;
        }
        if (node >= at.size() || !std::isfinite(at[node][0] + at[node][1] + at[node][2])) {
            text.fail("vertex " + std::to_string(node) + " has neither coordinates nor parents");
        }
        std::ranges::copy(at[node], mesh.coordinates.begin() + 3 * static_cast<std::ptrdiff_t>(vertex_of[node]));
    }
}

/** The mesh of the leaves: vertices that the files give coordinates come first, others as the leaves meet them. */
Mesh flatten(const Text& text, const Tree& tree) {
    Mesh mesh;
    mesh.dimension = tree.dimension;
    mesh.space_dimension = tree.space_dimension;
    const std::vector<std::size_t> leaves = collect_leaves(text, tree);
    std::size_t n_nodes = 0;
    for (std::size_t leaf : leaves) {
        n_nodes = std::max(n_nodes, std::size_t{1} + static_cast<std::size_t>(std::ranges::max(tree.elements[leaf].items)));
    }
    if (n_nodes > 8 * leaves.size() + tree.nodes.size() + tree.coordinates.size()) {
        text.fail("node " + std::to_string(n_nodes - 1) + " is beyond what the mesh can have");
    }
    std::vector<std::int32_t> vertex_of(n_nodes, -1);
    const auto is_top = [&](std::size_t node) { return node >= tree.nodes.size() || tree.nodes[node].first < 0; };
    constexpr std::int32_t used_top = -2;
    for (std::size_t leaf : leaves) {
        for (std::int32_t node : tree.elements[leaf].items) {
            const auto index = static_cast<std::size_t>(node);
            vertex_of[index] = is_top(index) ? used_top : -1;
        }
    }
    std::int32_t n_vertices = 0;
    for (std::int32_t& vertex : vertex_of) {
        if (vertex == used_top) {
            vertex = n_vertices++;
        }
    }
    for (std::size_t leaf : leaves) {
        MeshElement element;
        element.attribute = tree.elements[leaf].attribute;
        element.geometry = tree.elements[leaf].geometry;
        for (std::size_t corner = 0; corner < tree.elements[leaf].items.size(); ++corner) {
            std::int32_t& vertex = vertex_of[static_cast<std::size_t>(tree.elements[leaf].items[corner])];
            if (vertex < 0) {
                vertex = n_vertices++;
            }
            element.vertices[corner] = vertex;
        }
        mesh.elements.push_back(element);
    }
    mesh.n_vertices = static_cast<std::size_t>(n_vertices);
    add_boundary(tree, vertex_of, mesh);
    if (!tree.coordinates.empty()) {
        add_coordinates(text, tree, vertex_of, mesh);
    }
    return mesh;
}

} // namespace

Mesh read_nonconforming(Text& text, bool has_scales) {
    Tree tree;
    tree.dimension = read_dimension(text);
    if (text.accept("rank")) {
        text.fail("this is a part of a parallel mesh, which is not supported");
    }
    read_elements(text, tree);
    if (text.accept("boundary")) {
        tree.boundary.resize(text.count("the number of boundary elements", 8));
        for (BoundaryElement& element : tree.boundary) {
            element = read_boundary_element(text, tree.dimension, most);
        }
    }
    if (text.accept("vertex_parents")) {
        read_parents(text, tree, has_scales);
    }
    if (text.accept("root_state")) {
        tree.root_states.resize(text.count("the number of roots", 2));
        for (int& state : tree.root_states) {
            state = static_cast<int>(text.integer("the state of a root", 0, tree.dimension == 2 ? 7 : 23));
        }
    }
    if (text.accept("coordinates")) {
        const std::size_t n = text.count("the number of vertices with coordinates", 4);
        tree.coordinates = read_coordinates(text, n, tree.dimension, &tree.space_dimension);
    }
    Mesh mesh = flatten(text, tree);
    read_nodes(text, mesh);
    if (!mesh.nodes && mesh.coordinates.empty()) {
        text.fail("the mesh has neither coordinates nor nodes");
    }
    return mesh;
}

} // namespace elvis_mfem
