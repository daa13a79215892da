// MFEM, mesh/nurbs.cpp: the constructor of NURBSExtension from a stream, NURBSPatch, Get2DElementTopo, Get3DElementTopo.
#include "../text.hpp"
#include "../vertex_key.hpp"
#include "nurbs_patches.hpp"
#include "patch_lattice.hpp"

#include <elvis/native/space.hpp>
#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>

namespace elvis_mfem {

namespace {

constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();

/** An edge of the patches, with the number of its knot vector, which runs from its first vertex to its second. */
struct PatchEdge {
    std::size_t knots = 0;
    std::array<std::int32_t, 2> vertices{};
};

class Reader {
public:
    Reader(Text& text, int dimension) : m_text(text) { m_patches.dimension = dimension; }

    Mesh operator()() {
        read_topology();
        const bool has_patches = m_text.accept("patches");
        has_patches ? read_patches() : read_knots();
        number_control_points();
        has_patches ? gather_control_points() : read_weights();
        add_elements();
        m_result.dimension = m_patches.dimension;
        m_nurbs.dimension = m_patches.dimension;
        if (!has_patches) {
            // NURBS meshes write their nodes without a heading.
            take_nodes(m_text, m_result);
            if (m_result.nodes->nurbs_order == 0) {
                m_text.fail("the nodes of a NURBS mesh are not NURBS");
            }
        }
        m_result.nurbs = std::make_shared<NurbsPatches>(std::move(m_nurbs));
        return std::move(m_result);
    }

private:
    std::size_t n_axes() const { return static_cast<std::size_t>(m_patches.dimension); }

    void read_topology() {
        m_text.expect("elements");
        const std::size_t n_patches = m_text.count("the number of patches", 10);
        for (std::size_t patch = 0; patch < n_patches; ++patch) {
            MeshElement element;
            element.attribute = static_cast<int>(m_text.integer("an attribute", 0, most));
            element.geometry = read_geometry(m_text, m_patches.dimension);
            if (element.geometry != Geometry::square && element.geometry != Geometry::cube) {
                m_text.fail("a patch is neither a square nor a cube");
            }
            for (std::size_t corner = 0; corner < vertices(element.geometry).size(); ++corner) {
                element.vertices[corner] = static_cast<std::int32_t>(m_text.integer("a vertex", 0, most));
            }
            m_patches.elements.push_back(element);
        }
        m_text.expect("boundary");
        for (std::size_t n = m_text.count("the number of boundary elements", 8); n > 0; --n) {
            m_patches.boundary.push_back(read_boundary_element(m_text, m_patches.dimension, most));
        }
        m_text.expect("edges");
        for (std::size_t n = m_text.count("the number of edges", 6); n > 0; --n) {
            PatchEdge edge;
            edge.knots = static_cast<std::size_t>(m_text.integer("the number of a knot vector", 0, most));
            for (std::int32_t& vertex : edge.vertices) {
                vertex = static_cast<std::int32_t>(m_text.integer("a vertex", 0, most));
            }
            m_edges.push_back(edge);
        }
        m_text.expect("vertices");
        m_patches.n_vertices = static_cast<std::size_t>(m_text.integer("the number of vertices", 1, most));
        if (m_patches.n_vertices > 8 * m_patches.elements.size()) {
            m_text.fail("the patches cannot have " + std::to_string(m_patches.n_vertices) + " vertices");
        }
        for (const MeshElement& patch : m_patches.elements) {
            if (std::ranges::max(patch.vertices) >= static_cast<std::int32_t>(m_patches.n_vertices)) {
                m_text.fail("a patch has a vertex that does not exist");
            }
        }
    }

    /** Knot vectors of the whole mesh; those of the patches are found by their edges. */
    void read_knots() {
        m_text.expect("knotvectors");
        std::vector<KnotVector> all;
        for (std::size_t n = m_text.count("the number of knot vectors", 10); n > 0; --n) {
            all.push_back(read_knot_vector(m_text));
        }
        // How MFEM spaces new knots when it refines.
        if (m_text.accept("spacing")) {
            while (m_text.peek() != "weights" && !m_text.at_end()) {
                m_text.word("a word");
            }
        }
        std::map<std::pair<std::int32_t, std::int32_t>, const PatchEdge*> edge_at;
        for (const PatchEdge& edge : m_edges) {
            edge_at[{edge.vertices[0], edge.vertices[1]}] = &edge;
        }
        for (const MeshElement& element : m_patches.elements) {
            NurbsPatch& patch = m_nurbs.patches.emplace_back();
            // From the first corner along x, from the second along y, from the first along z.
            constexpr std::array<std::array<std::size_t, 2>, 3> along{{{0, 1}, {1, 2}, {0, 4}}};
            for (std::size_t axis = 0; axis < n_axes(); ++axis) {
                const auto from = element.vertices[along[axis][0]], to = element.vertices[along[axis][1]];
                const auto forward = edge_at.find({from, to}), backward = edge_at.find({to, from});
                const auto found = forward != edge_at.end() ? forward : backward;
                if (found == edge_at.end() || found->second->knots >= all.size()) {
                    m_text.fail("an edge of a patch has no knot vector");
                }
                const KnotVector& knots = all[found->second->knots];
                patch.knots[axis] = forward != edge_at.end() ? knots : knots.reversed();
            }
            // Weights take two bytes each; neighbours share some.
            check_size(patch, 1);
        }
    }

    /** Patches with knots and control points of their own. */
    void read_patches() {
        for (std::size_t patch = 0; patch < m_patches.elements.size(); ++patch) {
            m_text.expect("knotvectors");
            m_text.integer("the number of knot vectors", m_patches.dimension, m_patches.dimension);
            NurbsPatch& own = m_nurbs.patches.emplace_back();
            for (std::size_t axis = 0; axis < n_axes(); ++axis) {
                own.knots[axis] = read_knot_vector(m_text);
            }
            m_text.expect("dimension");
            const auto n_coordinates = static_cast<std::size_t>(m_text.integer("the dimension", m_patches.dimension, 3));
            if (patch > 0 && n_coordinates != m_n_coordinates) {
                m_text.fail("the patches have different numbers of coordinates");
            }
            m_n_coordinates = n_coordinates;
            const bool is_cartesian = m_text.accept("controlpoints_cartesian");
            if (!is_cartesian) {
                m_text.expect("controlpoints");
            }
            check_size(own, 2 * (n_coordinates + 1));
            std::vector<double>& points = m_points.emplace_back();
            for (std::size_t n = n_control_points(own); n > 0; --n) {
                const std::size_t first = points.size();
                for (std::size_t c = 0; c <= n_coordinates; ++c) {
                    points.push_back(m_text.real("a number of a control point"));
                    if (!std::isfinite(points.back())) {
                        m_text.fail("a number of a control point is not finite");
                    }
                }
                for (std::size_t c = 0; c < n_coordinates && !is_cartesian; ++c) {
                    points[first + c] /= points.back();
                }
            }
        }
    }

    std::size_t n_control_points(const NurbsPatch& patch) const {
        std::size_t result = 1;
        for (std::size_t axis = 0; axis < n_axes(); ++axis) {
            result *= static_cast<std::size_t>(patch.knots[axis].n_control_points());
        }
        return result;
    }

    /** Few knots can ask for many control points, which the file must hold, with some bytes each. */
    void check_size(const NurbsPatch& patch, std::size_t bytes) const {
        double n = 1;
        for (std::size_t axis = 0; axis < n_axes(); ++axis) {
            n *= patch.knots[axis].n_control_points();
        }
        if (static_cast<double>(bytes) * n > static_cast<double>(m_text.left() + bytes)) {
            m_text.fail("the file cannot hold the control points of a patch");
        }
    }

    PatchLattices number(const std::vector<LatticeSize>& sizes) const {
        std::vector<std::array<std::int32_t, 2>> edges;
        for (const PatchEdge& edge : m_edges) {
            edges.push_back(edge.vertices);
        }
        try {
            return number_lattices(m_patches, edges, sizes);
        } catch (const std::invalid_argument& error) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_text.path(), error.what());
        }
    }

    void number_control_points() {
        std::vector<LatticeSize> sizes;
        for (const NurbsPatch& patch : m_nurbs.patches) {
            LatticeSize& size = sizes.emplace_back(LatticeSize{1, 1, 1});
            for (std::size_t axis = 0; axis < n_axes(); ++axis) {
                size[axis] = patch.knots[axis].n_control_points();
            }
        }
        PatchLattices lattices = number(sizes);
        for (std::size_t patch = 0; patch < m_nurbs.patches.size(); ++patch) {
            m_nurbs.patches[patch].control_points = std::move(lattices.numbers[patch]);
        }
        m_nurbs.weights.assign(lattices.n_numbers, 1.0);
    }

    void check_weight(double weight) const {
        if (!(weight > 0) || !std::isfinite(weight)) {
            m_text.fail("a weight is not positive");
        }
    }

    void read_weights() {
        m_text.expect("weights");
        for (double& weight : m_nurbs.weights) {
            weight = m_text.real("a weight");
            check_weight(weight);
        }
    }

    void gather_control_points() {
        GridFunction nodes;
        nodes.nurbs_order = m_nurbs.patches.front().knots[0].order;
        nodes.n_components = static_cast<int>(m_n_coordinates);
        nodes.is_interleaved = true;
        nodes.values.resize(m_n_coordinates * m_nurbs.weights.size());
        for (std::size_t patch = 0; patch < m_points.size(); ++patch) {
            const double* point = m_points[patch].data();
            for (std::int32_t number : m_nurbs.patches[patch].control_points) {
                const auto at = static_cast<std::size_t>(number);
                std::copy_n(point, m_n_coordinates, nodes.values.begin() + static_cast<std::ptrdiff_t>(at * m_n_coordinates));
                m_nurbs.weights[at] = point[m_n_coordinates];
                check_weight(m_nurbs.weights[at]);
                point += m_n_coordinates + 1;
            }
        }
        m_result.space_dimension = nodes.n_components;
        m_result.nodes = std::move(nodes);
    }

    /** Spans between knots, with the vertices that the knots make. */
    void add_elements() {
        std::vector<std::array<std::vector<int>, 3>> spans;
        std::vector<LatticeSize> sizes;
        for (const NurbsPatch& patch : m_nurbs.patches) {
            auto& own = spans.emplace_back();
            own[2] = {0};
            LatticeSize& size = sizes.emplace_back(LatticeSize{1, 1, 1});
            for (std::size_t axis = 0; axis < n_axes(); ++axis) {
                own[axis] = patch.knots[axis].spans();
                size[axis] = static_cast<int>(own[axis].size()) + 1;
            }
        }
        const PatchLattices lattices = number(sizes);
        m_result.n_vertices = lattices.n_numbers;
        for (std::size_t patch = 0; patch < spans.size(); ++patch) {
            for (std::size_t k = 0; k < spans[patch][2].size(); ++k) {
                for (std::size_t j = 0; j < spans[patch][1].size(); ++j) {
                    for (std::size_t i = 0; i < spans[patch][0].size(); ++i) {
                        add_element(patch, {i, j, k}, sizes[patch], lattices.numbers[patch]);
                        m_nurbs.elements.push_back(
                            {static_cast<std::uint32_t>(patch), {spans[patch][0][i], spans[patch][1][j], spans[patch][2][k]}});
                    }
                }
            }
        }
        add_boundary(sizes);
    }

    void add_element(std::size_t patch, const std::array<std::size_t, 3>& at, const LatticeSize& size,
                     const std::vector<std::int32_t>& numbers) {
        MeshElement element = m_patches.elements[patch];
        const auto corners = vertices(element.geometry);
        for (std::size_t corner = 0; corner < corners.size(); ++corner) {
            const auto place = [&](std::size_t axis) { return at[axis] + static_cast<std::size_t>(corners[corner][axis]); };
            const auto n0 = static_cast<std::size_t>(size[0]), n1 = static_cast<std::size_t>(size[1]);
            element.vertices[corner] = numbers[place(0) + n0 * (place(1) + n1 * place(2))];
        }
        m_result.elements.push_back(element);
    }

    /** The sides of elements that lie in a side of a patch that is on the boundary. */
    void add_boundary(const std::vector<LatticeSize>& sizes) {
        std::map<VertexKey, int> attribute_at;
        for (const BoundaryElement& element : m_patches.boundary) {
            VertexKey key = element.vertices;
            std::ranges::sort(key);
            attribute_at.emplace(key, element.attribute);
        }
        std::size_t element = 0;
        for (std::size_t patch = 0; patch < sizes.size(); ++patch) {
            const auto count = [&](std::size_t axis) {
                return axis < n_axes() ? static_cast<std::size_t>(sizes[patch][axis]) - 1 : 1;
            };
            for (std::size_t n = 0; n < count(0) * count(1) * count(2); ++n, ++element) {
                const std::array<std::size_t, 3> at{n % count(0), n / count(0) % count(1), n / (count(0) * count(1))};
                for (const FaceVertices& side : sides()) {
                    add_side(patch, element, side, attribute_at,
                             [&](std::size_t axis, double end) { return at[axis] == (end == 0 ? 0 : count(axis) - 1); });
                }
            }
        }
    }

    /** Edges of a square with -1 behind, faces of a cube. */
    std::vector<FaceVertices> sides() const {
        std::vector<FaceVertices> result;
        if (n_axes() == 3) {
            result.assign(faces(Geometry::cube).begin(), faces(Geometry::cube).end());
        } else {
            for (const auto& edge : edges(Geometry::square)) {
                result.push_back({edge[0], edge[1], -1, -1});
            }
        }
        return result;
    }

    template <class IsAtEnd>
    void add_side(std::size_t patch, std::size_t element, const FaceVertices& side,
                  const std::map<VertexKey, int>& attribute_at, IsAtEnd&& is_at_end) {
        const Geometry geometry = m_patches.elements[patch].geometry;
        VertexKey key{-1, -1, -1, -1};
        BoundaryElement own;
        std::array<bool, 3> is_fixed{true, true, n_axes() == 3};
        const auto corners = vertices(geometry);
        for (std::size_t i = 0; i < side.size() && side[i] >= 0; ++i) {
            const auto corner = static_cast<std::size_t>(side[i]);
            key[i] = m_patches.elements[patch].vertices[corner];
            own.vertices[i] = m_result.elements[element].vertices[corner];
            for (std::size_t axis = 0; axis < 3; ++axis) {
                is_fixed[axis] = is_fixed[axis] && corners[corner][axis] == corners[static_cast<std::size_t>(side[0])][axis];
            }
        }
        std::ranges::sort(key);
        const auto found = attribute_at.find(key);
        const auto axis = static_cast<std::size_t>(std::ranges::find(is_fixed, true) - is_fixed.begin());
        if (found != attribute_at.end() && is_at_end(axis, corners[static_cast<std::size_t>(side[0])][axis])) {
            own.attribute = found->second;
            m_result.boundary.push_back(own);
        }
    }

    Text& m_text;
    /** Patches as elements. */
    Mesh m_patches;
    std::vector<PatchEdge> m_edges;
    std::size_t m_n_coordinates = 0;
    /** By patch: coordinates and weight of each control point. */
    std::vector<std::vector<double>> m_points;
    NurbsPatches m_nurbs;
    Mesh m_result;
};

/** From behind the dimension, 1: segments of one span each, with equal weights, which are Bernstein polynomials. */
Mesh read_segments(Text& text) {
    Mesh mesh;
    mesh.dimension = 1;
    text.expect("elements");
    for (std::size_t n = text.count("the number of segments", 8); n > 0; --n) {
        MeshElement& element = mesh.elements.emplace_back();
        element.attribute = static_cast<int>(text.integer("an attribute", 0, most));
        text.integer("the geometry of a segment", 1, 1);
        element.vertices[0] = static_cast<std::int32_t>(text.integer("a vertex", 0, most));
        element.vertices[1] = static_cast<std::int32_t>(text.integer("a vertex", 0, most));
    }
    text.expect("boundary");
    for (std::size_t n = text.count("the number of boundary elements", 6); n > 0; --n) {
        mesh.boundary.push_back(read_boundary_element(text, 1, most));
    }
    text.expect("edges");
    for (std::size_t n = 3 * text.count("the number of edges", 6); n > 0; --n) {
        text.integer("a knot vector or vertex of an edge", 0, most);
    }
    text.expect("vertices");
    mesh.n_vertices = static_cast<std::size_t>(text.integer("the number of vertices", 1, most));
    text.expect("knotvectors");
    int order = 0;
    for (std::size_t n = text.count("the number of knot vectors", 10); n > 0; --n) {
        const KnotVector knots = read_knot_vector(text);
        if (knots.spans().size() != 1 || (order != 0 && knots.order != order)) {
            text.fail("NURBS segments of several spans, or of several orders, are not supported");
        }
        order = knots.order;
    }
    text.expect("weights");
    const std::size_t n_points = mesh.n_vertices + mesh.elements.size() * static_cast<std::size_t>(std::max(1, order) - 1);
    double first = 0;
    for (std::size_t i = 0; i < n_points; ++i) {
        const double weight = text.real("a weight");
        first = i == 0 ? weight : first;
        if (!(weight > 0) || weight != first) {
            text.fail("NURBS segments with weights that differ are not supported");
        }
    }
    for (const auto& element : mesh.elements) {
        if (std::max(element.vertices[0], element.vertices[1]) >= static_cast<std::int32_t>(mesh.n_vertices)) {
            text.fail("a segment has a vertex that does not exist");
        }
    }
    mesh.nodes = read_grid_function(text);
    if (mesh.nodes->nurbs_order != order) {
        text.fail("the nodes of a NURBS mesh are not NURBS of the mesh's order");
    }
    mesh.nodes->nurbs_order = 0;
    mesh.nodes->collection = {.family = Family::h1, .dimension = 1, .order = order, .basis = Basis::positive};
    return mesh;
}

} // namespace

Mesh read_nurbs(Text& text) {
    const int dimension = read_dimension(text, 1);
    return dimension == 1 ? read_segments(text) : Reader(text, dimension)();
}

} // namespace elvis_mfem
