#include "mesh.hpp"

#include "element/nodes.hpp"
#include "sections.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace elvis_cgns {

namespace {

std::vector<std::uint32_t> face_corners(std::span<const std::uint32_t> nodes, Topology topology, std::size_t face) {
    const std::span<const int> order = source_corners(topology);
    std::vector<std::uint32_t> corners;
    for (const int corner : elvis::native::face_corners(shape(topology), static_cast<int>(face))) {
        corners.push_back(nodes[static_cast<std::size_t>(order[static_cast<std::size_t>(corner)])]);
    }
    return corners;
}

std::size_t n_faces(Topology topology) { return static_cast<std::size_t>(elvis::native::n_faces(shape(topology))); }

std::uint32_t dimension_of(std::int64_t type) { return static_cast<std::uint32_t>(dimension(element_type(type).topology)); }

constexpr std::int64_t quad_4_number = 7, hexa_8_number = 17;

/** Cells of a structured zone, the first index the fastest; corners counted from 0. */
void for_each_cell(const Zone& zone, const TakeElement& take) {
    const auto n_i = static_cast<std::uint32_t>(zone.n_vertices[0]), n_j = static_cast<std::uint32_t>(zone.n_vertices[1]);
    const bool is_flat = zone.n_indices == 2;
    for (std::uint64_t k = 0; k < (is_flat ? 1 : zone.n_cells[2]); ++k) {
        for (std::uint64_t j = 0; j < zone.n_cells[1]; ++j) {
            for (std::uint64_t i = 0; i < zone.n_cells[0]; ++i) {
                const auto low = static_cast<std::uint32_t>(i + n_i * (j + n_j * k)), high = low + n_i * n_j;
                const std::array<std::uint32_t, 8> corners{low,  low + 1,  low + 1 + n_i,  low + n_i,
                                                           high, high + 1, high + 1 + n_i, high + n_i};
                take(is_flat ? quad_4_number : hexa_8_number, std::span(corners).first(is_flat ? 4 : 8));
            }
        }
    }
}

/** Which faces of a zone belong to which of its groups. */
class FaceGroups {
public:
    explicit FaceGroups(const std::vector<BoundaryGroup>& groups) {
        for (std::size_t group = 0; group < groups.size(); ++group) {
            for (const FaceKey& key : groups[group].faces) {
                m_of_face.try_emplace(key, group);
            }
            if (!groups[group].vertices.empty()) {
                std::vector<std::uint32_t> sorted = groups[group].vertices;
                std::ranges::sort(sorted);
                m_is_of_any.resize(std::max<std::size_t>(m_is_of_any.size(), std::size_t{sorted.back()} + 1));
                for (const std::uint32_t vertex : sorted) {
                    m_is_of_any[vertex] = true;
                }
                m_of_vertices.push_back({group, std::move(sorted)});
            }
        }
    }

    bool is_empty() const { return m_of_face.empty() && m_of_vertices.empty(); }

    /** Index of the group that has the face itself. */
    const std::size_t* of_face(const FaceKey& key) const {
        const auto found = m_of_face.find(key);
        return found == m_of_face.end() ? nullptr : &found->second;
    }
    /** Index of the first group that has all its corners. */
    const std::size_t* of_corners(const FaceKey& key) const {
        // Most faces are inside.
        if (key[0] >= m_is_of_any.size() || !m_is_of_any[key[0]]) {
            return nullptr;
        }
        for (const OfVertices& set : m_of_vertices) {
            const bool has_all = std::ranges::all_of(key, [&](std::uint32_t corner) {
                return corner == no_corner || std::ranges::binary_search(set.vertices, corner);
            });
            if (has_all) {
                return &set.group;
            }
        }
        return nullptr;
    }

private:
    struct OfVertices {
        std::size_t group;
        std::vector<std::uint32_t> vertices;
    };
    std::unordered_map<FaceKey, std::size_t, FaceKeyHash> m_of_face;
    std::vector<OfVertices> m_of_vertices;
    std::vector<bool> m_is_of_any;
};

/** A face that a group has by its corners. */
struct Candidate {
    std::uint64_t face;
    std::size_t group;
    /** Faces between two elements are none of the boundary. */
    int n_elements;
};

/** Gets faces as 8 * element + face, counted in the zone, with the index of the group. */
using TakeFace = std::function<void(std::uint64_t face, std::size_t group)>;

void find_faces(const Mesh& mesh, std::uint64_t first_element, std::uint32_t first_vertex, const FaceGroups& groups,
                const TakeFace& take) {
    std::unordered_map<FaceKey, Candidate, FaceKeyHash> candidates;
    for (std::uint64_t element = first_element; element < mesh.n_elements(); ++element) {
        const Topology topology = mesh.type(element).topology;
        for (std::size_t face = 0; face < n_faces(topology); ++face) {
            std::vector<std::uint32_t> corners = face_corners(mesh.nodes(element), topology, face);
            for (std::uint32_t& corner : corners) {
                corner -= first_vertex;
            }
            const FaceKey key = face_key(corners);
            const std::uint64_t number = 8 * element + face;
            if (const std::size_t* const group = groups.of_face(key)) {
                take(number, *group);
            } else if (const std::size_t* const by_corners = groups.of_corners(key)) {
                ++candidates.try_emplace(key, Candidate{number, *by_corners, 0}).first->second.n_elements;
            }
        }
    }
    for (const auto& [key, candidate] : candidates) {
        if (candidate.n_elements == 1) {
            take(candidate.face, candidate.group);
        }
    }
}

/** Elements of one dimension less than the cells become faces of the boundary, others of fewer are left out. */
class ZoneReader {
public:
    ZoneReader(Tree& tree, const Base& base, const Zone& zone) : m_tree(tree), m_base(base), m_zone(zone) {}

    void read(const TakeElement& take) {
        if (m_zone.is_structured) {
            for_each_cell(m_zone, take);
            return;
        }
        std::uint64_t n_cells = 0;
        for (const Section& section : read_sections(m_tree, m_zone)) {
            BoundarySection boundary{section.node.name, section.first, {}};
            bool has_faces = false;
            const bool is_all_cells = section.type != mixed_number && dimension_of(section.type) == m_base.dimension;
            read_elements(m_tree, m_zone, section, [&](std::int64_t type, std::span<const std::uint32_t> nodes) {
                const std::uint32_t dimension = dimension_of(type);
                if (dimension > m_base.dimension) {
                    section.node.fail("holds " + type_name(type) + " in a base of " + std::to_string(m_base.dimension) +
                                      " dimensions");
                }
                n_cells += dimension == m_base.dimension ? 1 : 0;
                if (dimension == m_base.dimension) {
                    take(type, nodes);
                    if (is_all_cells) {
                        return;
                    }
                }
                // An element that is no face keeps the place of its number.
                const bool is_face = dimension + 1 == m_base.dimension;
                has_faces = has_faces || is_face;
                boundary.faces.push_back(face_key(nodes.first(is_face ? n_corners(element_type(type).topology) : 0)));
            });
            if (has_faces) {
                boundaries.push_back(std::move(boundary));
            }
        }
        if (n_cells != m_zone.n_all_cells()) {
            m_zone.node.fail("says that it has " + std::to_string(m_zone.n_all_cells()) + " cells; its sections hold " +
                             std::to_string(n_cells) + " elements of " + std::to_string(m_base.dimension) + " dimensions");
        }
    }

    std::vector<BoundarySection> boundaries;

private:
    Tree& m_tree;
    const Base& m_base;
    const Zone& m_zone;
};

} // namespace

Mesh::Mesh(Tree& tree, const Base& base, const std::string& coordinates, const elvis::api::Host& host) {
    for (const Zone& zone : base.zones) {
        host.check_cancelled();
        if (n_vertices() + zone.n_all_vertices() >= no_corner) {
            zone.node.fail("has more vertices than can be read");
        }
        const auto first_vertex = static_cast<std::uint32_t>(n_vertices());
        m_zones.push_back(n_elements());
        read_points(tree, base, zone, coordinates);
        std::vector<std::uint32_t> in_mesh;
        ZoneReader reader(tree, base, zone);
        reader.read([&](std::int64_t type, std::span<const std::uint32_t> nodes) {
            in_mesh.assign(nodes.begin(), nodes.end());
            for (std::uint32_t& node : in_mesh) {
                node += first_vertex;
            }
            append_element(type, in_mesh);
        });
        add_groups(read_boundary(tree, zone, reader.boundaries, host), first_vertex);
    }
    m_has_shared_vertices = m_connectivity.size() > n_vertices();
}

void Mesh::add_groups(const std::vector<BoundaryGroup>& groups, std::uint32_t first_vertex) {
    std::vector<std::int32_t> in_mesh;
    for (const BoundaryGroup& group : groups) {
        const auto found = std::ranges::find(m_groups, group.name);
        in_mesh.push_back(static_cast<std::int32_t>(found - m_groups.begin()));
        if (found == m_groups.end()) {
            m_groups.push_back(group.name);
        }
    }
    const FaceGroups of_zone(groups);
    if (!of_zone.is_empty()) {
        find_faces(*this, m_zones.back(), first_vertex, of_zone,
                   [&](std::uint64_t face, std::size_t group) { m_face_groups.emplace(face, in_mesh[group]); });
    }
}

void Mesh::read_points(Tree& tree, const Base& base, const Zone& zone, const std::string& name) {
    const auto grid = tree.named(zone.node, name);
    if (!grid) {
        zone.node.fail("has no " + name);
    }
    const std::size_t first = m_points.size();
    constexpr std::array names{"CoordinateX", "CoordinateY", "CoordinateZ"};
    for (std::size_t axis = 0; axis < base.n_coordinates; ++axis) {
        const auto array = tree.named(*grid, names[axis]);
        if (!array) {
            grid->fail(std::string("has no ") + names[axis] + "; other coordinates than Cartesian ones are not read");
        }
        m_mantissa_bits = std::min(m_mantissa_bits, elvis_cgns::mantissa_bits(*array));
        const std::vector<double> values = read_array(tree, *grid, *array, zone, zone.n_vertices);
        // Only now is it known that the zone is as large as it says.
        m_points.resize(first + 3 * values.size());
        for (std::size_t vertex = 0; vertex < values.size(); ++vertex) {
            if (!std::isfinite(values[vertex])) {
                array->fail("is not finite at vertex " + std::to_string(vertex + 1));
            }
            m_points[first + 3 * vertex + axis] = values[vertex];
        }
    }
}

void Mesh::append_element(std::int64_t type, std::span<const std::uint32_t> nodes) {
    m_types.push_back(static_cast<std::uint8_t>(type));
    m_connectivity.insert(m_connectivity.end(), nodes.begin(), nodes.end());
    m_first.push_back(m_connectivity.size());
}

std::size_t Mesh::zone(std::uint64_t element) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(m_zones, element) - m_zones.begin()) - 1;
}

std::int32_t Mesh::face_group(std::uint64_t element, std::size_t face) const {
    const auto found = m_face_groups.find(8 * element + face);
    return found == m_face_groups.end() ? ELVIS_GROUP_NONE : found->second;
}

} // namespace elvis_cgns
