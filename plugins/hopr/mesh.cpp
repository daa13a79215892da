#include "mesh.hpp"

#include "line_nodes.hpp"

#include <plugins/nodal/linear_element.hpp>

#include <algorithm>
#include <cmath>

namespace elvis_hopr {

namespace {

/** Elements that are read at a time. */
constexpr std::uint64_t block_size = 16384;
/** Columns of ElemInfo. */
enum ElementColumn { element_type, zone, first_side, last_side, first_node, last_node, n_element_columns };
/** Of BCType, and what its first column says of sides between elements. */
constexpr std::uint64_t n_condition_columns = 4;
constexpr std::int64_t inner_condition = 100;

/** Types of elements end with the number of their corners. */
std::string shape_name(std::int64_t type) {
    switch (type % 10) {
    case 4:
        return "a tetrahedron";
    case 5:
        return "a pyramid";
    case 6:
        return "a prism";
    default:
        return "of type " + std::to_string(type);
    }
}

/** A dataset of two dimensions with that many columns. */
elvis::hdf5::Dataset table(const elvis::hdf5::File& file, const std::string& name, std::uint64_t n_columns) {
    elvis::hdf5::Dataset data = file.dataset(name);
    if (data.shape().size() != 2 || data.shape()[1] != n_columns) {
        data.fail("has not rows of " + std::to_string(n_columns) + " numbers");
    }
    return data;
}

} // namespace

bool is_mesh(const elvis::hdf5::File& file) {
    return file.has("ElemInfo") && file.has("NodeCoords") && file.has_attribute("/", "Ngeo");
}

Mesh::Mesh(elvis::hdf5::File file, const elvis::api::Host& host)
    : m_file(std::move(file)), m_coordinates(table(m_file, "NodeCoords", 3)),
      m_sides(table(m_file, "SideInfo", n_side_columns)) {
    const std::int64_t order = integer_attribute("Ngeo");
    if (order < 1 || order > most_order) {
        m_file.fail("/@Ngeo", "is " + std::to_string(order) + "; orders 1 to " + std::to_string(most_order) + " are read");
    }
    m_nodes =
        std::make_unique<const elvis::nodal::NodalSpace>(elvis::native::Shape::hexahedron, static_cast<std::uint32_t>(order),
                                                         cube_of(equidistant_nodes(static_cast<std::uint32_t>(order))));
    m_corners = elvis::nodal::corner_nodes(elvis::native::Shape::hexahedron, m_nodes->nodes());
    read_elements();
    read_conditions();
    if (m_file.has("GlobalNodeIDs")) {
        m_ids = std::make_unique<const elvis::hdf5::Dataset>(m_file.dataset("GlobalNodeIDs"));
        if (m_ids->shape() != std::vector{m_coordinates.shape()[0]}) {
            m_ids->fail("has not one number for each row of NodeCoords");
        }
        m_n_corner_ids = m_coordinates.shape()[0];
    }
    find_linear_elements(host);
}

std::int64_t Mesh::integer_attribute(const std::string& name) const {
    const std::vector<double> values = m_file.numbers_of_attribute("/", name);
    if (values.size() != 1 || !(std::abs(values.front()) < 1e9)) {
        m_file.fail("/@" + name, "is not one number");
    }
    return static_cast<std::int64_t>(values.front());
}

void Mesh::read_elements() {
    const elvis::hdf5::Dataset data = table(m_file, "ElemInfo", n_element_columns);
    const std::uint64_t n = data.shape()[0], n_nodes = m_nodes->size();
    if (n == 0) {
        data.fail("has no elements");
    }
    m_first_node = {0};
    m_first_side = {0};
    std::vector<std::int64_t> rows;
    for (std::uint64_t first = 0; first < n; first += block_size) {
        const std::uint64_t count = std::min(block_size, n - first);
        rows.resize(count * n_element_columns);
        data.read({first, 0}, {count, n_element_columns}, std::span(rows));
        for (std::uint64_t index = 0; index < count; ++index) {
            const std::int64_t* const row = &rows[index * n_element_columns];
            const std::string which = "has element " + std::to_string(first + index + 1) + ", ";
            if (row[element_type] % 10 != 8) {
                data.fail(which + "which is " + shape_name(row[element_type]) + "; hexahedra only are read");
            }
            if (row[first_node] != static_cast<std::int64_t>(m_first_node.back()) ||
                row[last_node] - row[first_node] != static_cast<std::int64_t>(n_nodes)) {
                data.fail(which + "whose nodes are not the next " + std::to_string(n_nodes) + " rows of NodeCoords");
            }
            if (row[first_side] != static_cast<std::int64_t>(m_first_side.back()) || row[last_side] < row[first_side] ||
                static_cast<std::uint64_t>(row[last_side]) > m_sides.shape()[0]) {
                data.fail(which + "whose sides are not the next rows of SideInfo");
            }
            m_first_node.push_back(static_cast<std::uint64_t>(row[last_node]));
            m_first_side.push_back(static_cast<std::uint64_t>(row[last_side]));
        }
    }
    if (m_first_node.back() > m_coordinates.shape()[0]) {
        m_coordinates.fail("has " + std::to_string(m_coordinates.shape()[0]) + " rows, but ElemInfo needs " +
                           std::to_string(m_first_node.back()));
    }
}

void Mesh::read_conditions() {
    m_groups = m_file.texts("BCNames");
    const elvis::hdf5::Dataset types = table(m_file, "BCType", n_condition_columns);
    if (types.shape()[0] != m_groups.size()) {
        types.fail("has " + std::to_string(types.shape()[0]) + " rows for " + std::to_string(m_groups.size()) + " names");
    }
    std::vector<std::int64_t> rows(m_groups.size() * n_condition_columns);
    types.read({0, 0}, {m_groups.size(), n_condition_columns}, std::span(rows));
    for (std::size_t index = 0; index < m_groups.size(); ++index) {
        m_is_inner.push_back(rows[index * n_condition_columns] == inner_condition);
    }
}

void Mesh::find_linear_elements(const elvis::api::Host& host) {
    const elvis::nodal::LinearElement is_linear(*m_nodes, m_corners);
    const std::size_t n_numbers = 3 * m_nodes->size();
    for (std::uint64_t first = 0; first < n_elements(); first += block_size) {
        host.check_cancelled();
        const std::uint64_t count = std::min(block_size, n_elements() - first);
        const std::vector<double> positions = read_nodes(first, count);
        for (std::uint64_t element = 0; element < count; ++element) {
            const std::span own(&positions[n_numbers * element], n_numbers);
            if (!std::ranges::all_of(own, [](double number) { return std::isfinite(number); })) {
                m_coordinates.fail("has a node of element " + std::to_string(first + element + 1) + " that is not finite");
            }
            m_linear.push_back(is_linear(own.data()));
        }
    }
}

std::vector<double> Mesh::read_nodes(std::uint64_t first, std::uint64_t count) const {
    std::vector<double> positions(3 * m_nodes->size() * count);
    m_coordinates.read({m_first_node[first], 0}, {m_nodes->size() * count, 3}, std::span(positions));
    return positions;
}

std::vector<ElementTopology> Mesh::read_topology(std::uint64_t first, std::uint64_t count) const {
    std::vector<ElementTopology> all(count);
    const std::uint64_t n_nodes = m_nodes->size(), n_rows = m_first_side[first + count] - m_first_side[first];
    std::vector<std::int64_t> ids(m_ids ? n_nodes * count : 0), sides(n_rows * n_side_columns);
    m_sides.read({m_first_side[first], 0}, {n_rows, n_side_columns}, std::span(sides));
    if (m_ids) {
        m_ids->read({m_first_node[first]}, {n_nodes * count}, std::span(ids));
    }
    for (std::uint64_t element = 0; element < count; ++element) {
        for (std::size_t corner = 0; m_ids && corner < n_corners; ++corner) {
            const std::int64_t id = ids[element * n_nodes + m_corners[corner]];
            if (id < 1 || static_cast<std::uint64_t>(id) > m_n_corner_ids) {
                m_ids->fail("has number " + std::to_string(id) + " in element " + std::to_string(first + element + 1));
            }
            all[element].corners[corner] = id - 1;
        }
        const std::uint64_t from = m_first_side[first + element] - m_first_side[first];
        const std::uint64_t to = m_first_side[first + element + 1] - m_first_side[first];
        all[element].groups =
            groups_of(first + element, std::span(sides).subspan(from * n_side_columns, (to - from) * n_side_columns));
    }
    return all;
}

std::array<std::int32_t, n_faces> Mesh::groups_of(std::uint64_t element, std::span<const std::int64_t> rows) const {
    std::array<std::int32_t, n_faces> groups;
    groups.fill(ELVIS_GROUP_NONE);
    const std::string which = "of element " + std::to_string(element + 1) + " ";
    std::size_t face = 0;
    for (std::size_t at = 0; at < rows.size(); ++face, at += n_side_columns) {
        if (face == n_faces) {
            m_sides.fail(which + "are more than six");
        }
        const std::int64_t condition_number = rows[at + condition];
        if (condition_number < 0 || static_cast<std::size_t>(condition_number) > m_groups.size()) {
            m_sides.fail(which + "have boundary condition " + std::to_string(condition_number) + " of " +
                         std::to_string(m_groups.size()));
        }
        if (condition_number > 0 && !m_is_inner[static_cast<std::size_t>(condition_number - 1)]) {
            groups[face] = static_cast<std::int32_t>(condition_number - 1);
        }
        // A mortar: its small sides follow, four for -1, two for -2 and -3.
        const std::int64_t small = rows[at + neighbour];
        if (small < 0) {
            at += (small == -1 ? 4 : 2) * std::size_t{n_side_columns};
        }
    }
    if (face != n_faces) {
        m_sides.fail(which + "are " + std::to_string(face) + " instead of six");
    }
    return groups;
}

} // namespace elvis_hopr
