#include "boundary.hpp"

#include <algorithm>
#include <tuple>

namespace elvis_cgns {

namespace {

using Index = std::array<std::int64_t, 3>;

std::uint64_t vertex_of(const Zone& zone, const Index& index) {
    const auto along = [&](std::size_t axis) { return static_cast<std::uint64_t>(index[axis] - 1); };
    return along(0) + zone.n_vertices[0] * (along(1) + zone.n_vertices[1] * along(2));
}

/** The patch of a boundary condition: ranges and lists of indices, as the file gives them. */
class Patch {
public:
    Patch(Tree& tree, const Zone& zone, const Node& condition) : m_zone(zone) {
        for (const Node& child : tree.children(condition)) {
            const bool is_range = child.name == "PointRange" || child.name == "ElementRange";
            if (is_range || child.name == "PointList" || child.name == "ElementList") {
                m_points = child;
                m_is_range = is_range;
                m_is_of_elements = child.name.starts_with("Element");
            }
        }
        m_location = grid_location(tree, condition);
    }

    bool is_given() const { return m_points.has_value(); }
    bool is_at_vertices() const { return !m_is_of_elements && m_location == "Vertex"; }
    bool is_of_faces() const { return m_is_of_elements || m_location.ends_with("FaceCenter") || m_location == "EdgeCenter"; }
    const std::string& location() const { return m_location; }
    const Node& node() const { return *m_points; }

    /** The index that a structured zone's faces lie across: that of the location's name, or that which does not vary. */
    std::size_t across() const {
        if (m_location.size() > 1 && m_location[0] >= 'I' && m_location[0] <= 'K') {
            return static_cast<std::size_t>(m_location[0] - 'I');
        }
        const std::vector<std::int64_t> ends = range();
        for (std::size_t axis = 0; axis < m_zone.n_indices; ++axis) {
            if (ends[axis] == ends[m_zone.n_indices + axis]) {
                return axis;
            }
        }
        m_points->fail("is no plane of the zone");
    }

    /** Calls visit(index) for all of them; each index is from 1 to what `most` says. */
    template <class Visit> void for_each(const Index& most, Visit visit) const {
        const std::size_t n = m_zone.n_indices;
        const auto check = [&](const Index& index) {
            for (std::size_t axis = 0; axis < n; ++axis) {
                if (index[axis] < 1 || index[axis] > most[axis]) {
                    m_points->fail("names " + std::to_string(index[axis]) + " where 1 to " + std::to_string(most[axis]) +
                                   " are possible");
                }
            }
        };
        if (!m_is_range) {
            const std::vector<std::int64_t> all = integers(*m_points);
            for (std::size_t at = 0; at + n <= all.size(); at += n) {
                Index index{1, 1, 1};
                std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(at), n, index.begin());
                check(index);
                visit(index);
            }
            return;
        }
        const std::vector<std::int64_t> ends = range();
        Index low{1, 1, 1}, high{1, 1, 1};
        for (std::size_t axis = 0; axis < n; ++axis) {
            std::tie(low[axis], high[axis]) = std::minmax(ends[axis], ends[n + axis]);
        }
        check(low);
        check(high);
        for (std::int64_t k = low[2]; k <= high[2]; ++k) {
            for (std::int64_t j = low[1]; j <= high[1]; ++j) {
                for (std::int64_t i = low[0]; i <= high[0]; ++i) {
                    visit({i, j, k});
                }
            }
        }
    }

private:
    std::vector<std::int64_t> range() const {
        std::vector<std::int64_t> ends = m_is_range ? integers(*m_points) : std::vector<std::int64_t>{};
        if (ends.size() != 2 * m_zone.n_indices) {
            m_points->fail("is no range of the zone's indices");
        }
        return ends;
    }

    const Zone& m_zone;
    std::optional<Node> m_points;
    std::string m_location;
    bool m_is_range = false;
    bool m_is_of_elements = false;
};

std::string name_of(Tree& tree, const Node& condition) {
    const auto family = tree.child(condition, "FamilyName_t");
    const std::string name = family ? text(*family) : "";
    return name.empty() ? condition.name : name;
}

void add_vertices(const Zone& zone, const Patch& patch, BoundaryGroup& group) {
    Index most{1, 1, 1};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        most[axis] = static_cast<std::int64_t>(zone.n_vertices[axis]);
    }
    patch.for_each(most,
                   [&](const Index& index) { group.vertices.push_back(static_cast<std::uint32_t>(vertex_of(zone, index))); });
}

/** Faces of cells: across one index they are counted as vertices are, along the others as cells. */
void add_structured_faces(const Zone& zone, const Patch& patch, BoundaryGroup& group) {
    const std::size_t across = patch.across();
    if (across >= zone.n_indices) {
        patch.node().fail("is across an index that the zone does not have");
    }
    Index most{1, 1, 1};
    for (std::size_t axis = 0; axis < zone.n_indices; ++axis) {
        most[axis] = static_cast<std::int64_t>(axis == across ? zone.n_vertices[axis] : zone.n_cells[axis]);
    }
    const std::size_t first = across == 0 ? 1 : 0, second = across == 2 ? 1 : 2;
    patch.for_each(most, [&](const Index& index) {
        std::vector<std::uint32_t> corners;
        for (int b = 0; b < (zone.n_indices == 3 ? 2 : 1); ++b) {
            for (int a = 0; a < 2; ++a) {
                Index vertex = index;
                vertex[first] += a;
                vertex[second] += b;
                corners.push_back(static_cast<std::uint32_t>(vertex_of(zone, vertex)));
            }
        }
        group.faces.push_back(face_key(corners));
    });
}

/** Elements by their numbers. Marks sections of which there are some. */
void add_elements(const Patch& patch, const std::vector<BoundarySection>& sections, std::vector<bool>& is_named,
                  BoundaryGroup& group) {
    constexpr std::int64_t most = std::int64_t{1} << 40;
    patch.for_each({most, most, most}, [&](const Index& index) {
        const auto number = static_cast<std::uint64_t>(index[0]);
        for (std::size_t at = 0; at < sections.size(); ++at) {
            if (number >= sections[at].first && number - sections[at].first < sections[at].faces.size()) {
                group.faces.push_back(sections[at].faces[number - sections[at].first]);
                is_named[at] = true;
                return;
            }
        }
        patch.node().fail("names element " + std::to_string(number) + ", which is none of the boundary");
    });
}

} // namespace

FaceKey face_key(std::span<const std::uint32_t> corners) {
    FaceKey key{no_corner, no_corner, no_corner, no_corner};
    std::ranges::copy(corners, key.begin());
    std::ranges::sort(key);
    return key;
}

std::size_t FaceKeyHash::operator()(const FaceKey& key) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t corner : key) {
        // Fibonacci hashing: 2^64 over the golden ratio.
        hash = (hash ^ corner) * 0x9E3779B97F4A7C15u;
        hash ^= hash >> 32;
    }
    return hash;
}

std::vector<BoundaryGroup> read_boundary(Tree& tree, const Zone& zone, const std::vector<BoundarySection>& sections,
                                         const elvis::api::Host& host) {
    std::vector<BoundaryGroup> groups;
    std::vector<bool> is_named(sections.size());
    for (const Node& all : tree.children(zone.node, "ZoneBC_t")) {
        for (const Node& condition : tree.children(all, "BC_t")) {
            const Patch patch(tree, zone, condition);
            BoundaryGroup group{name_of(tree, condition), {}, {}};
            if (!patch.is_given()) {
                continue;
            }
            if (patch.is_at_vertices()) {
                add_vertices(zone, patch, group);
            } else if (!patch.is_of_faces()) {
                host.log(ELVIS_LOG_WARNING, tree.path() + ": " + condition.path + " is left out: it lies at " +
                                                patch.location() + ", not at faces or vertices");
                continue;
            } else if (zone.is_structured) {
                add_structured_faces(zone, patch, group);
            } else {
                add_elements(patch, sections, is_named, group);
            }
            groups.push_back(std::move(group));
        }
    }
    for (std::size_t at = 0; at < sections.size(); ++at) {
        if (!is_named[at]) {
            groups.push_back({sections[at].name, sections[at].faces, {}});
        }
    }
    return groups;
}

} // namespace elvis_cgns
