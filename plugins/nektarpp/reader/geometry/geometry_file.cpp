#include "geometry_file.hpp"

#include "../field/expression.hpp"
#include "../text/number_text.hpp"
#include "compressed_geometry.hpp"

#include <elvis/plugin.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace nektarpp {

namespace {

/** Orders of the native volume end at 30. */
constexpr std::uint32_t most_points_along = elvis::native::max_order + 1;

/** Scaling and shift of the mesh, x' = x * scale + move. */
struct Placement {
    Position scale{1, 1, 1};
    Position move{};
    /** Third coordinates are ignored. */
    bool is_flat = false;

    Position operator()(const Position& x) const {
        Position placed{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            placed[axis] = x[axis] * scale[axis] + move[axis];
        }
        if (is_flat) {
            placed[2] = 0;
        }
        return placed;
    }
};

std::optional<Shape> shape_of_tag(std::string_view tag, int dimension) {
    if (dimension == 2) {
        return tag == "T" ? std::optional(Shape::triangle) : tag == "Q" ? std::optional(Shape::quadrilateral) : std::nullopt;
    }
    return tag == "H"   ? std::optional(Shape::hexahedron)
           : tag == "R" ? std::optional(Shape::prism)
           : tag == "P" ? std::optional(Shape::pyramid)
           : tag == "A" ? std::optional(Shape::tetrahedron)
                        : std::nullopt;
}

class Reader {
public:
    Reader(const XmlFile& file, GeometryData& data) : m_file(file), m_data(data), m_is_first(data.vertices.empty()) {}

    void read() {
        const pugi::xml_node geometry = m_file.root().child("GEOMETRY");
        if (!geometry) {
            m_file.fail(m_file.root(), "has no GEOMETRY");
        }
        if (geometry.attribute("HDF5FILE")) {
            throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, m_file.path(),
                                    "keeps its mesh in an HDF5 file; only XML meshes of Nektar++ can be read");
        }
        read_dimensions(geometry);
        read_vertices(child(geometry, "VERTEX"));
        read_edges(child(geometry, "EDGE"));
        if (m_data.dimension == 3) {
            read_faces(child(geometry, "FACE"));
        }
        read_elements(child(geometry, "ELEMENT"));
        if (const pugi::xml_node curved = geometry.child("CURVED")) {
            read_curves(curved);
        }
        if (const pugi::xml_node composites = geometry.child("COMPOSITE")) {
            read_composites(composites);
        }
        if (const pugi::xml_node domain = geometry.child("DOMAIN")) {
            read_domain(domain);
        }
    }

private:
    void read_dimensions(const pugi::xml_node& geometry);
    void read_placement(const pugi::xml_node& node);
    void read_vertices(const pugi::xml_node& node);
    void read_edges(const pugi::xml_node& node);
    void read_faces(const pugi::xml_node& node);
    void read_elements(const pugi::xml_node& node);
    void read_curves(const pugi::xml_node& node);
    void read_composites(const pugi::xml_node& node);
    void read_domain(const pugi::xml_node& node);
    void add_curve(const pugi::xml_node& node, bool is_edge, CurveRecord& record);
    PointSet point_set(const pugi::xml_node& node) const;

    pugi::xml_node child(const pugi::xml_node& parent, const char* name) const {
        const pugi::xml_node found = parent.child(name);
        if (!found) {
            m_file.fail(parent, std::string("has no ") + name);
        }
        return found;
    }

    /** Partitions repeat what they share; within one file an id may be defined once. */
    template <class Map> void add(Map& map, const pugi::xml_node& node, std::int64_t id, typename Map::mapped_type value) {
        if (!map.emplace(id, std::move(value)).second && m_is_first) {
            m_file.fail(node, "id " + std::to_string(id) + " is defined twice");
        }
    }

    /** Records {id, sides} of one kind of entity: one plain node, or all of a compressed one. */
    template <class Take> void read_sides(const pugi::xml_node& node, bool is_packed, std::uint32_t n, Take&& take) {
        std::array<std::int64_t, 6> sides{};
        if (is_packed) {
            for_each_record(m_file, node, n + 1, [&](Record record) {
                std::ranges::transform(record.subspan(1), sides.begin(), integer_of);
                take(integer_of(record[0]), sides);
            });
            return;
        }
        NumberText text(m_file, node);
        for (std::uint32_t side = 0; side < n; ++side) {
            sides[side] = text.integer();
        }
        text.expect_end();
        take(m_file.integer(node, "ID"), sides);
    }

    const XmlFile& m_file;
    GeometryData& m_data;
    bool m_is_first;
    Placement m_place;
};

void Reader::read_dimensions(const pugi::xml_node& geometry) {
    const std::int64_t dimension = m_file.integer(geometry, "DIM");
    const std::int64_t space = geometry.attribute("SPACE") ? m_file.integer(geometry, "SPACE") : dimension;
    if ((dimension != 2 && dimension != 3) || space < dimension || space > 3) {
        m_file.fail(geometry, "DIM " + std::to_string(dimension) + " and SPACE " + std::to_string(space) +
                                  "; only DIM 2 and 3 can be read, in a SPACE of as many dimensions or 3");
    }
    if (m_data.dimension != 0 && (m_data.dimension != dimension || m_data.space_dimension != space)) {
        m_file.fail(geometry, "DIM or SPACE differs from the other partitions");
    }
    m_data.dimension = static_cast<int>(dimension);
    m_data.space_dimension = static_cast<int>(space);
    m_place.is_flat = space == 2;
}

void Reader::read_placement(const pugi::xml_node& node) {
    constexpr const char* names[2][3] = {{"XSCALE", "YSCALE", "ZSCALE"}, {"XMOVE", "YMOVE", "ZMOVE"}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const bool is_move : {false, true}) {
            const char* name = names[is_move ? 1 : 0][axis];
            if (const pugi::xml_attribute attribute = node.attribute(name)) {
                try {
                    (is_move ? m_place.move : m_place.scale)[axis] = evaluate_expression(attribute.value());
                } catch (const std::invalid_argument& error) {
                    m_file.fail(node, std::string("attribute ") + name + ", " + error.what());
                }
            }
        }
    }
}

void Reader::read_vertices(const pugi::xml_node& node) {
    read_placement(node);
    const auto add_vertex = [&](const pugi::xml_node& where, std::int64_t id, const Position& x) {
        const Position placed = m_place(x);
        if (!std::ranges::all_of(placed, [](double coordinate) { return std::isfinite(coordinate); })) {
            m_file.fail(where, "vertex " + std::to_string(id) + " is not finite");
        }
        add(m_data.vertices, where, id, placed);
    };
    if (m_file.is_compressed(node)) {
        for_each_record(m_file, node, 4, [&](Record record) {
            add_vertex(node, integer_of(record[0]), position_of(m_file, node, record.subspan(1)));
        });
        return;
    }
    for (const pugi::xml_node& vertex : node.children("V")) {
        NumberText text(m_file, vertex);
        Position x{};
        for (double& coordinate : x) {
            coordinate = text.real();
        }
        text.expect_end();
        add_vertex(vertex, m_file.integer(vertex, "ID"), x);
    }
}

void Reader::read_edges(const pugi::xml_node& node) {
    const auto add_edge = [&](const pugi::xml_node& where) {
        return [this, where](std::int64_t id, const std::array<std::int64_t, 6>& ends) {
            for (std::size_t end = 0; end < 2; ++end) {
                if (!m_data.vertices.contains(ends[end])) {
                    m_file.fail(where, "edge " + std::to_string(id) + " ends at vertex " + std::to_string(ends[end]) +
                                           ", which is missing");
                }
            }
            if (ends[0] == ends[1]) {
                m_file.fail(where, "edge " + std::to_string(id) + " ends where it begins");
            }
            add(m_data.edges, where, id, {ends[0], ends[1]});
        };
    };
    if (m_file.is_compressed(node)) {
        read_sides(node, true, 2, add_edge(node));
        return;
    }
    for (const pugi::xml_node& edge : node.children("E")) {
        read_sides(edge, false, 2, add_edge(edge));
    }
}

void Reader::read_faces(const pugi::xml_node& node) {
    for (const pugi::xml_node& child : node.children()) {
        const std::string_view tag = child.name();
        if (tag.empty()) {
            continue;
        }
        if (tag != "T" && tag != "Q") {
            m_file.fail(child, "is no face; T and Q are");
        }
        const std::uint32_t n_edges = tag == "T" ? 3 : 4;
        read_sides(child, m_file.is_compressed(child), n_edges, [&](std::int64_t id, const std::array<std::int64_t, 6>& edges) {
            Face face;
            face.n_edges = n_edges;
            std::copy_n(edges.begin(), n_edges, face.edges.begin());
            for (std::uint32_t edge = 0; edge < n_edges; ++edge) {
                if (!m_data.edges.contains(face.edges[edge])) {
                    m_file.fail(child, "face " + std::to_string(id) + " has edge " + std::to_string(face.edges[edge]) +
                                           ", which is missing");
                }
            }
            add(m_data.faces, child, id, face);
        });
    }
}

void Reader::read_elements(const pugi::xml_node& node) {
    for (const pugi::xml_node& child : node.children()) {
        if (child.type() != pugi::node_element) {
            continue;
        }
        const std::optional<Shape> shape = shape_of_tag(child.name(), m_data.dimension);
        if (!shape) {
            m_file.fail(child, "is no element of dimension " + std::to_string(m_data.dimension));
        }
        read_sides(child, m_file.is_compressed(child), n_sides(*shape),
                   [&](std::int64_t id, const std::array<std::int64_t, 6>& sides) {
                       m_data.elements.push_back({*shape, id, sides, m_data.n_parts - 1});
                   });
    }
}

PointSet Reader::point_set(const pugi::xml_node& node) const {
    const std::string_view type = m_file.attribute(node, "TYPE");
    if (type == "PolyEvenlySpaced") {
        return PointSet::evenly_spaced;
    }
    if (type == "GaussLobattoLegendre") {
        return PointSet::gauss_lobatto;
    }
    if (type == "NodalTriEvenlySpaced") {
        return PointSet::triangle_evenly_spaced;
    }
    if (type == "NodalTriElec") {
        return PointSet::triangle_electrostatic;
    }
    if (type == "NodalTriFekete") {
        return PointSet::triangle_fekete;
    }
    m_file.fail(node, "points of TYPE \"" + std::string(type) +
                          "\"; known are PolyEvenlySpaced, GaussLobattoLegendre, NodalTriEvenlySpaced, NodalTriElec and "
                          "NodalTriFekete");
}

void Reader::read_curves(const pugi::xml_node& node) {
    if (m_file.is_compressed(node)) {
        read_compressed_curves(m_file, node, [&](const pugi::xml_node& where, CurveRecord& record) {
            add_curve(where, std::string_view(where.name()) == "E", record);
        });
        return;
    }
    for (const pugi::xml_node& child : node.children()) {
        const std::string_view tag = child.name();
        if (tag != "E" && tag != "F") {
            continue;
        }
        CurveRecord record;
        record.entity = m_file.integer(child, tag == "E" ? "EDGEID" : "FACEID");
        record.n_points = m_file.integer(child, "NUMPOINTS");
        record.set = point_set(child);
        NumberText text(m_file, child);
        while (!text.at_end()) {
            Position x{};
            for (double& coordinate : x) {
                coordinate = text.real();
            }
            record.points.push_back(x);
        }
        if (static_cast<std::int64_t>(record.points.size()) != record.n_points) {
            m_file.fail(child, "NUMPOINTS is " + std::to_string(record.n_points) + ", but there are " +
                                   std::to_string(record.points.size()) + " points");
        }
        add_curve(child, tag == "E", record);
    }
}

/** Number of points along an edge; the reader has checked that no more than `most_points_along` come out. */
std::uint32_t points_along(bool is_edge, bool is_triangle, std::size_t n_points) {
    for (std::uint32_t n = 2; n <= most_points_along; ++n) {
        const std::size_t total = is_edge ? n : is_triangle ? n * (n + 1) / 2 : n * n;
        if (total == n_points) {
            return n;
        }
    }
    return 0;
}

void Reader::add_curve(const pugi::xml_node& node, bool is_edge, CurveRecord& record) {
    const bool is_triangle = record.set != PointSet::evenly_spaced && record.set != PointSet::gauss_lobatto;
    const std::string which = std::string(is_edge ? "edge " : "face ") + std::to_string(record.entity);
    if (is_edge && is_triangle) {
        m_file.fail(node, "the points of " + which + " are those of a triangle");
    }
    Curve curve;
    curve.set = record.set;
    curve.n_along = points_along(is_edge, is_triangle, record.points.size());
    if (curve.n_along == 0) {
        m_file.fail(node, std::to_string(record.points.size()) + " points on " + which + "; possible are " +
                              (is_edge       ? "n"
                               : is_triangle ? "n(n+1)/2"
                                             : "n*n") +
                              " with n from 2 to " + std::to_string(most_points_along));
    }
    curve.points.reserve(record.points.size());
    for (const Position& x : record.points) {
        curve.points.push_back(m_place(x));
        if (!std::ranges::all_of(curve.points.back(), [](double coordinate) { return std::isfinite(coordinate); })) {
            m_file.fail(node, "a point of " + which + " is not finite");
        }
    }
    add(is_edge ? m_data.edge_curves : m_data.face_curves, node, record.entity, std::move(curve));
}

void Reader::read_composites(const pugi::xml_node& node) {
    std::unordered_map<std::int64_t, std::size_t> place;
    for (const Composite& composite : m_data.composites) {
        place.emplace(composite.id, place.size());
    }
    for (const pugi::xml_node& child : node.children("C")) {
        Composite composite;
        composite.id = m_file.integer(child, "ID");
        composite.name = child.attribute("NAME").value();
        composite.groups = parse_groups(m_file, child, text_of(child));
        const auto [known, is_new] = place.emplace(composite.id, m_data.composites.size());
        if (is_new) {
            m_data.composites.push_back(std::move(composite));
        } else {
            std::vector<IdGroup>& groups = m_data.composites[known->second].groups;
            groups.insert(groups.end(), composite.groups.begin(), composite.groups.end());
        }
    }
}

void Reader::read_domain(const pugi::xml_node& node) {
    const auto read_text = [&](const pugi::xml_node& where) {
        for (const IdGroup& group : parse_groups(m_file, where, text_of(where))) {
            if (group.kind != 'C') {
                m_file.fail(where, "a domain consists of composites, C[...]");
            }
            m_data.domain.insert(m_data.domain.end(), group.ranges.begin(), group.ranges.end());
        }
    };
    read_text(node);
    // Version 5 may list several domains.
    for (const pugi::xml_node& part : node.children("D")) {
        read_text(part);
    }
}

} // namespace

void read_geometry(const XmlFile& file, GeometryData& data) { Reader(file, data).read(); }

} // namespace nektarpp
