#include "mesh.hpp"

#include "boundary.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <numeric>

namespace nektarpp {

namespace {

namespace native = elvis::native;

/** Corners of a local face; in two dimensions those of the element, its only face. */
std::vector<int> corners_of_face(Shape shape, int local_face) {
    if (native::dimension(shape) == 2) {
        return shape == Shape::triangle ? std::vector<int>{0, 1, 2} : std::vector<int>{0, 1, 2, 3};
    }
    const std::span<const int> corners = native::face_corners(shape, local_face);
    return {corners.begin(), corners.end()};
}

} // namespace

class Mesh::Builder {
public:
    Builder(Mesh& mesh, const GeometryData& data) : m_mesh(mesh), m_data(data) {}

    void run() {
        const std::vector<bool> is_in_domain = elements_of_domain(m_data);
        BoundaryGroups groups = find_boundary_groups(m_data, is_in_domain);
        m_mesh.m_groups = std::move(groups.names);
        m_mesh.m_n_parts = m_data.n_parts;
        for (const std::size_t index : order_of_ids()) {
            const ElementRecord& record = m_data.elements[index];
            m_mesh.m_index.push_back({record.shape, record.id, is_in_domain[index] ? m_mesh.m_elements.size() : no_number});
            if (is_in_domain[index]) {
                add(record);
                m_mesh.m_elements.back().groups = groups.of_element[index];
            }
        }
        if (m_mesh.m_elements.empty()) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_data.path,
                                    "the domain holds no elements of dimension " + std::to_string(m_data.dimension));
        }
        sort_index();
    }

private:
    /** The file lists elements shape by shape; by their ids people know them. */
    std::vector<std::size_t> order_of_ids() const {
        std::vector<std::size_t> order(m_data.elements.size());
        std::iota(order.begin(), order.end(), 0);
        std::ranges::stable_sort(order, {}, [this](std::size_t index) { return m_data.elements[index].id; });
        return order;
    }

    void add(const ElementRecord& record) {
        const LocalElement local = number_locally(m_data, record);
        MeshElement element;
        element.shape = record.shape;
        element.id = record.id;
        element.sides = record.sides;
        element.part = record.part;
        element.first_bend = m_mesh.m_bends.size();
        for (std::size_t corner = 0; corner < static_cast<std::size_t>(native::n_corners(record.shape)); ++corner) {
            element.corners[corner] = vertex(local.corners[corner]);
        }
        for (std::size_t edge = 0; edge < local_edges(record.shape).size(); ++edge) {
            if (const auto bubble = edge_bubble(local.edges[edge])) {
                Bend bend;
                bend.bubble = *bubble;
                bend.local = static_cast<std::uint8_t>(edge);
                bend.is_reversed[0] = local.is_reversed[edge];
                add(bend, element);
            }
        }
        if (m_data.dimension == 2) {
            // A curve on a face with the element's id bends its interior.
            const auto n_edges = static_cast<std::size_t>(native::n_corners(record.shape));
            bend_face(record, record.id, {record.sides.data(), n_edges}, 0, local, element);
        }
        for (int face = 0; m_data.dimension == 3 && face < native::n_faces(record.shape); ++face) {
            const std::int64_t id = record.sides[static_cast<std::size_t>(face)];
            const Face& of_data = m_data.faces.at(id);
            bend_face(record, id, {of_data.edges.data(), of_data.n_edges}, face, local, element);
        }
        // Bubbles of a pyramid's base reach twice their order in the collapsed direction.
        if (record.shape == Shape::pyramid && target_order(mapping_modes(element))[2] > native::max_order) {
            fail(record, "curves of " + std::to_string(element.n_along) + " points; pyramids can have at most " +
                             std::to_string(native::max_order / 2 + 2));
        }
        m_mesh.m_elements.push_back(element);
    }

    std::uint32_t vertex(std::int64_t id) {
        const auto [found, is_new] = m_vertices.try_emplace(id, static_cast<std::uint32_t>(m_mesh.m_vertices.size()));
        if (is_new) {
            m_mesh.m_vertices.push_back(m_data.vertices.at(id));
        }
        return found->second;
    }

    void add(const Bend& bend, MeshElement& element) {
        element.n_along = std::max(element.n_along, m_mesh.m_bubbles[bend.bubble].n_along);
        ++element.n_bends;
        m_mesh.m_bends.push_back(bend);
    }

    std::uint32_t add(Bubble bubble) {
        m_mesh.m_bubbles.push_back(std::move(bubble));
        return static_cast<std::uint32_t>(m_mesh.m_bubbles.size() - 1);
    }

    std::optional<std::uint32_t> edge_bubble(std::int64_t edge) {
        const auto curve = m_data.edge_curves.find(edge);
        if (curve == m_data.edge_curves.end() || curve->second.n_along <= 2) {
            return std::nullopt;
        }
        const auto [found, is_new] = m_edge_bubbles.try_emplace(edge, 0u);
        if (is_new) {
            found->second = add(m_fitter.fit_edge(curve->second));
        }
        return found->second;
    }

    void bend_face(const ElementRecord& record, std::int64_t id, std::span<const std::int64_t> edges, int local_face,
                   const LocalElement& local, MeshElement& element) {
        const auto found = m_data.face_curves.find(id);
        if (found == m_data.face_curves.end() || found->second.n_along <= 2) {
            return;
        }
        const Curve& curve = found->second;
        const bool is_triangle = curve.set != PointSet::evenly_spaced && curve.set != PointSet::gauss_lobatto;
        if (is_triangle != (edges.size() == 3)) {
            fail(record, "face " + std::to_string(id) + " is curved by the points of a " +
                             (is_triangle ? "triangle" : "quadrilateral"));
        }
        Bend bend;
        bend.is_face = true;
        bend.local = static_cast<std::uint8_t>(local_face);
        bend.bubble = face_bubble(record, id, curve, is_triangle);
        const std::vector<std::int64_t> frame = face_frame(m_data, edges, "face " + std::to_string(id));
        std::vector<std::int64_t> corners;
        for (const int corner : corners_of_face(record.shape, local_face)) {
            corners.push_back(local.corners[static_cast<std::size_t>(corner)]);
        }
        if (is_triangle) {
            if (frame[2] != corners[2]) {
                fail(record, "its curved face " + std::to_string(id) +
                                 " is collapsed at another vertex than that which its last two edges share");
            }
            bend.is_reversed[0] = frame[0] != corners[0];
        } else {
            turn(bend, record, frame, corners);
        }
        add(bend, element);
    }

    std::uint32_t face_bubble(const ElementRecord& record, std::int64_t id, const Curve& curve, bool is_triangle) {
        const auto [found, is_new] = m_face_bubbles.try_emplace(id, 0u);
        if (is_new) {
            std::optional<Bubble> bubble = is_triangle ? m_fitter.fit_triangle(curve) : m_fitter.fit_quadrilateral(curve);
            if (!bubble) {
                fail(record, "face " + std::to_string(id) + " has " + std::to_string(curve.n_along) +
                                 " points along an edge; NodalTriElec is known to 12, NodalTriFekete to 10 and for 12");
            }
            found->second = add(std::move(*bubble));
        }
        return found->second;
    }

    /** One of the eight ways in which a quadrilateral's own frame lies in the local one. */
    void turn(Bend& bend, const ElementRecord& record, const std::vector<std::int64_t>& frame,
              const std::vector<std::int64_t>& corners) const {
        // Coordinates (-1 or 1) in the frame of its corner that is local corner 0, 1 or 3.
        const auto in_frame = [&](std::size_t corner) -> std::array<int, 2> {
            constexpr std::array<std::array<int, 2>, 4> coordinates{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
            const auto at = std::ranges::find(frame, corners[corner]);
            if (at == frame.end()) {
                fail(record, "the edges of a curved face do not join its corners");
            }
            return coordinates[static_cast<std::size_t>(at - frame.begin())];
        };
        const std::array<int, 2> origin = in_frame(0), along_first = in_frame(1), along_second = in_frame(3);
        bend.is_transposed = along_first[0] == origin[0];
        // Local direction 0 is the frame's 0, or 1 if transposed.
        bend.is_reversed[0] = origin[bend.is_transposed ? 1 : 0] > along_first[bend.is_transposed ? 1 : 0];
        bend.is_reversed[1] = origin[bend.is_transposed ? 0 : 1] > along_second[bend.is_transposed ? 0 : 1];
    }

    void sort_index() {
        std::vector<Entry>& index = m_mesh.m_index;
        std::ranges::sort(index, {}, [](const Entry& entry) { return std::pair(entry.shape, entry.id); });
        const auto twice = std::ranges::adjacent_find(
            index, [](const Entry& a, const Entry& b) { return a.shape == b.shape && a.id == b.id; });
        if (twice != index.end()) {
            throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_data.path,
                                    std::string(native::name(twice->shape)) + " " + std::to_string(twice->id) +
                                        " is defined twice");
        }
    }

    [[noreturn]] void fail(const ElementRecord& record, const std::string& what) const {
        throw elvis::api::Error(ELVIS_ERROR_FORMAT, m_data.path, name_of(record) + ": " + what);
    }

    Mesh& m_mesh;
    const GeometryData& m_data;
    CurveFitter m_fitter;
    std::unordered_map<std::int64_t, std::uint32_t> m_vertices;
    std::unordered_map<std::int64_t, std::uint32_t> m_edge_bubbles;
    std::unordered_map<std::int64_t, std::uint32_t> m_face_bubbles;
};

Mesh::Mesh(const GeometryData& data) : m_dimension(data.dimension), m_path(data.path) { Builder(*this, data).run(); }

Mesh::Found Mesh::find(Shape shape, std::int64_t id) const {
    const auto at = std::ranges::lower_bound(m_index, std::pair(shape, id), {},
                                             [](const Entry& entry) { return std::pair(entry.shape, entry.id); });
    if (at == m_index.end() || at->shape != shape || at->id != id) {
        return {};
    }
    return {true, at->number == no_number ? std::nullopt : std::optional(at->number)};
}

void Mesh::mapping_coefficients(const MeshElement& element, std::vector<double>& coefficients) const {
    const ModeSet modes = mapping_modes(element);
    const std::uint32_t n = element.n_along;
    // Position of each mode among the coefficients.
    std::vector<std::uint32_t> position(static_cast<std::size_t>(n) * n * n);
    std::uint32_t n_coefficients = 0;
    const auto at = [&](const ModeIndex& index) -> std::uint32_t& {
        return position[(index[0] * n + index[1]) * n + index[2]];
    };
    for_each_mode(modes, [&](const ModeIndex& index) { at(index) = n_coefficients++; });
    coefficients.assign(3 * static_cast<std::size_t>(n_coefficients), 0.0);
    const auto set = [&](const ModeIndex& index, const Position& x, double sign) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            coefficients[axis * n_coefficients + at(index)] = sign * x[axis];
        }
    };
    for (int corner = 0; corner < native::n_corners(element.shape); ++corner) {
        set(corner_mode(element.shape, corner), m_vertices[element.corners[static_cast<std::size_t>(corner)]], 1);
    }
    for (std::uint64_t index = element.first_bend; index < element.first_bend + element.n_bends; ++index) {
        const Bend& bend = m_bends[index];
        const Bubble& bubble = m_bubbles[bend.bubble];
        const ModeRule& rule = bend.is_face ? face_modes(element.shape, bend.local) : edge_modes(element.shape, bend.local);
        const std::size_t n_corners = bend.is_face ? corners_of_face(element.shape, bend.local).size() : 2;
        std::size_t mode = 0;
        for_each_bubble_mode(bubble.n_along, n_corners, [&](std::uint32_t i, std::uint32_t j) {
            if (bend.is_transposed) {
                std::swap(i, j);
            }
            // Modes are even or odd in their direction as their index is.
            const bool is_negative = (bend.is_reversed[0] && i % 2 == 1) != (bend.is_reversed[1] && j % 2 == 1);
            set(apply(rule, i, j), bubble.modes[mode++], is_negative ? -1 : 1);
        });
    }
}

} // namespace nektarpp
