#include "local_numbering.hpp"

#include "../geometry/shape_tables.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <optional>

namespace nektarpp {

namespace {

[[noreturn]] void fail(const GeometryData& data, const std::string& which, const std::string& what) {
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, data.path, which + ": " + what);
}

/** The one number that both lists hold. */
std::optional<std::int64_t> common(std::span<const std::int64_t> a, std::span<const std::int64_t> b) {
    std::optional<std::int64_t> found;
    for (const std::int64_t id : a) {
        if (std::ranges::find(b, id) != b.end()) {
            if (found && *found != id) {
                return std::nullopt;
            }
            found = id;
        }
    }
    return found;
}

bool holds(std::span<const int> corners, int corner) { return std::ranges::find(corners, corner) != corners.end(); }

class Numbering {
public:
    Numbering(const GeometryData& data, const ElementRecord& element)
        : m_data(data), m_element(element), m_edges(local_edges(element.shape)) {}

    LocalElement run() {
        if (m_data.dimension == 2) {
            std::copy_n(m_element.sides.begin(), m_edges.size(), m_local.edges.begin());
        } else {
            find_edges();
        }
        find_corners();
        return m_local;
    }

private:
    const Face& face(int local_face) const {
        const std::int64_t id = m_element.sides[static_cast<std::size_t>(local_face)];
        const auto found = m_data.faces.find(id);
        if (found == m_data.faces.end()) {
            fail("its face " + std::to_string(id) + " is missing");
        }
        const std::size_t n_wanted = elvis::native::face_corners(m_element.shape, local_face).size();
        if (found->second.n_edges != n_wanted) {
            fail("its local face " + std::to_string(local_face) + " has " + std::to_string(found->second.n_edges) +
                 " edges instead of " + std::to_string(n_wanted));
        }
        return found->second;
    }

    /** A local edge is what the two faces with both its corners have in common. */
    void find_edges() {
        for (std::size_t edge = 0; edge < m_edges.size(); ++edge) {
            std::array<const Face*, 2> sides{};
            std::size_t n_found = 0;
            for (int local_face = 0; local_face < elvis::native::n_faces(m_element.shape); ++local_face) {
                const std::span<const int> corners = elvis::native::face_corners(m_element.shape, local_face);
                if (holds(corners, m_edges[edge].from) && holds(corners, m_edges[edge].to)) {
                    sides.at(n_found++) = &face(local_face);
                }
            }
            const auto shared = common(edges_of(*sides[0]), edges_of(*sides[1]));
            if (!shared) {
                fail("the two faces at its local edge " + std::to_string(edge) + " do not share exactly one edge");
            }
            m_local.edges[edge] = *shared;
        }
    }

    static std::span<const std::int64_t> edges_of(const Face& face) { return {face.edges.data(), face.n_edges}; }

    const std::array<std::int64_t, 2>& ends(std::size_t edge) const {
        const auto found = m_data.edges.find(m_local.edges[edge]);
        if (found == m_data.edges.end()) {
            fail("its edge " + std::to_string(m_local.edges[edge]) + " is missing");
        }
        return found->second;
    }

    void find_corners() {
        for (int corner = 0; corner < elvis::native::n_corners(m_element.shape); ++corner) {
            std::array<std::size_t, 2> at_corner{};
            std::size_t n_found = 0;
            for (std::size_t edge = 0; edge < m_edges.size() && n_found < 2; ++edge) {
                if (m_edges[edge].from == corner || m_edges[edge].to == corner) {
                    at_corner[n_found++] = edge;
                }
            }
            const auto shared = common(ends(at_corner[0]), ends(at_corner[1]));
            if (!shared) {
                fail("edges " + std::to_string(m_local.edges[at_corner[0]]) + " and " +
                     std::to_string(m_local.edges[at_corner[1]]) + " do not share exactly one vertex");
            }
            m_local.corners[static_cast<std::size_t>(corner)] = *shared;
        }
        for (std::size_t edge = 0; edge < m_edges.size(); ++edge) {
            const std::int64_t from = m_local.corners[static_cast<std::size_t>(m_edges[edge].from)];
            const std::int64_t to = m_local.corners[static_cast<std::size_t>(m_edges[edge].to)];
            const std::array<std::int64_t, 2>& of_file = ends(edge);
            m_local.is_reversed[edge] = of_file[0] == to && of_file[1] == from;
            if (!m_local.is_reversed[edge] && !(of_file[0] == from && of_file[1] == to)) {
                fail("its edge " + std::to_string(m_local.edges[edge]) + " does not join the vertices of its place");
            }
        }
    }

    [[noreturn]] void fail(const std::string& what) const { nektarpp::fail(m_data, name_of(m_element), what); }

    const GeometryData& m_data;
    const ElementRecord& m_element;
    std::span<const LocalEdge> m_edges;
    LocalElement m_local;
};

} // namespace

LocalElement number_locally(const GeometryData& data, const ElementRecord& element) { return Numbering(data, element).run(); }

std::vector<std::int64_t> face_frame(const GeometryData& data, std::span<const std::int64_t> edges, const std::string& which) {
    std::vector<std::int64_t> frame;
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        const auto here = data.edges.find(edges[edge]);
        const auto next = data.edges.find(edges[(edge + 1) % edges.size()]);
        if (here == data.edges.end() || next == data.edges.end()) {
            fail(data, which, "one of its edges is missing");
        }
        const auto shared = common(here->second, next->second);
        if (!shared) {
            fail(data, which, "its edges do not follow each other");
        }
        frame.push_back(here->second[0] == *shared ? here->second[1] : here->second[0]);
    }
    return frame;
}

std::string name_of(const ElementRecord& element) {
    return std::string(elvis::native::name(element.shape)) + " " + std::to_string(element.id);
}

} // namespace nektarpp
