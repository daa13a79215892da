#include "mesh.hpp"

#include <elvis/native/space.hpp>
#include <plugins/cgns/element/nodes.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace elvis_exodus {

namespace {

std::uint64_t needed(const NetCdf& file, const char* dimension) {
    const std::optional<std::uint64_t> length = file.dimension(dimension);
    if (!length) {
        file.fail("", std::string("has no dimension '") + dimension + "': this is no Exodus II file");
    }
    return *length;
}

/** Name i of a list, if there is one, else PREFIX and the id. */
std::string name_of(const std::vector<std::string>& names, const std::vector<std::int64_t>& ids, std::size_t index,
                    const char* prefix) {
    if (index < names.size() && !names[index].empty()) {
        return names[index];
    }
    return std::string(prefix) + std::to_string(index < ids.size() ? ids[index] : static_cast<std::int64_t>(index + 1));
}

std::vector<std::string> texts_or_none(const NetCdf& file, const char* variable) {
    return file.has(variable) ? file.texts(variable) : std::vector<std::string>();
}

std::vector<std::int64_t> integers_or_none(const NetCdf& file, const char* variable) {
    return file.has(variable) ? file.integers(variable) : std::vector<std::int64_t>();
}

} // namespace

Mesh::Mesh(const NetCdf& file, const elvis::api::Host& host) {
    read_points(file);
    read_blocks(file, host);
    read_side_sets(file);
}

void Mesh::read_points(const NetCdf& file) {
    const std::uint64_t n_axes = needed(file, "num_dim"), n_nodes = needed(file, "num_nodes");
    if (n_axes < 1 || n_axes > 3) {
        file.fail("num_dim", "is " + std::to_string(n_axes) + ", not 1, 2 or 3");
    }
    if (n_nodes >= ~std::uint32_t{0}) {
        file.fail("num_nodes", "is more than can be read");
    }
    constexpr const char* names[] = {"coordx", "coordy", "coordz"};
    for (std::uint64_t axis = 0; axis < n_axes; ++axis) {
        const bool is_one_array = file.has("coord");
        const std::string variable = is_one_array ? "coord" : names[axis];
        std::vector<double> values(n_nodes);
        if (is_one_array) {
            file.read(variable, {axis, 0}, {1, n_nodes}, values);
        } else {
            file.read(variable, {0}, {n_nodes}, values);
        }
        m_mantissa_bits = std::min(m_mantissa_bits, file.mantissa_bits(variable));
        // Only now is it known that the file is as large as it says.
        m_points.resize(3 * n_nodes);
        for (std::uint64_t node = 0; node < n_nodes; ++node) {
            if (!std::isfinite(values[node])) {
                file.fail(variable, "is not finite at node " + std::to_string(node + 1));
            }
            m_points[3 * node + axis] = values[node];
        }
    }
}

void Mesh::read_blocks(const NetCdf& file, const elvis::api::Host& host) {
    const std::uint64_t n_blocks = needed(file, "num_el_blk");
    const std::vector<std::string> names = texts_or_none(file, "eb_names");
    const std::vector<std::int64_t> ids = integers_or_none(file, "eb_prop1");
    std::vector<Block> all;
    int most = 0;
    for (std::uint64_t number = 1; number <= n_blocks; ++number) {
        const std::string suffix = std::to_string(number), connectivity = "connect" + suffix;
        Block block;
        block.number = number;
        block.name = name_of(names, ids, number - 1, "block ");
        block.first_in_file = m_n_in_file;
        block.n_elements = file.dimension("num_el_in_blk" + suffix).value_or(0);
        m_n_in_file += block.n_elements;
        if (block.n_elements == 0) {
            continue; // Blocks of other parts of the mesh are empty.
        }
        const Extents shape = file.shape(connectivity);
        if (shape.size() != 2 || shape[0] != block.n_elements) {
            file.fail(connectivity, "has not the shape that its block needs");
        }
        const std::string type = file.attribute(connectivity, "elem_type").value_or("");
        try {
            block.type = block_type(type, shape[1]);
        } catch (const std::invalid_argument& reason) {
            throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, file.path(), "block '" + block.name + "': " + reason.what());
        }
        block.is_shell = elvis_cgns::dimension(block.type.topology) == 2 && needed(file, "num_dim") == 3;
        most = std::max(most, elvis_cgns::dimension(block.type.topology));
        all.push_back(std::move(block));
    }
    if (most < 2) {
        throw elvis::api::Error(ELVIS_ERROR_UNSUPPORTED, file.path(), "has no elements of two or three dimensions");
    }
    m_dimension = static_cast<std::uint32_t>(most);
    for (Block& block : all) {
        if (elvis_cgns::dimension(block.type.topology) < most) {
            host.log(ELVIS_LOG_WARNING, file.path() + ": block '" + block.name + "' is left out: its elements have " +
                                            std::to_string(elvis_cgns::dimension(block.type.topology)) + " dimensions, not " +
                                            std::to_string(most));
            continue;
        }
        host.check_cancelled();
        block.first_element = m_n_elements;
        read_connectivity(file, block);
        m_n_elements += block.n_elements;
        m_blocks.push_back(std::move(block));
    }
}

void Mesh::read_connectivity(const NetCdf& file, Block& block) {
    const std::string variable = "connect" + std::to_string(block.number);
    const std::vector<std::int64_t> numbers = file.integers(variable);
    const std::size_t n = numbers.size() / block.n_elements;
    const std::span<const int> order = node_order(block.type);
    block.nodes.reserve(numbers.size());
    for (std::uint64_t element = 0; element < block.n_elements; ++element) {
        for (std::size_t node = 0; node < n; ++node) {
            const std::size_t place = order.empty() ? node : static_cast<std::size_t>(order[node]);
            const std::int64_t number = numbers[element * n + place];
            if (number < 1 || static_cast<std::uint64_t>(number) > n_nodes()) {
                file.fail(variable, "element " + std::to_string(element + 1) + " has node " + std::to_string(number) +
                                        ", which does not exist");
            }
            block.nodes.push_back(static_cast<std::uint32_t>(number - 1));
        }
    }
}

void Mesh::read_side_sets(const NetCdf& file) {
    const std::uint64_t n_sets = file.dimension("num_side_sets").value_or(0);
    const std::vector<std::string> names = texts_or_none(file, "ss_names");
    const std::vector<std::int64_t> ids = integers_or_none(file, "ss_prop1");
    for (std::uint64_t set = 0; set < n_sets; ++set) {
        const std::string suffix = std::to_string(set + 1);
        if (!file.has("elem_ss" + suffix)) {
            continue; // Empty, as in parts of a mesh.
        }
        const std::string name = name_of(names, ids, set, "side set ");
        const auto found = std::ranges::find(m_groups, name);
        const auto group = static_cast<std::int32_t>(found - m_groups.begin());
        if (found == m_groups.end()) {
            m_groups.push_back(name);
        }
        const std::vector<std::int64_t> elements = file.integers("elem_ss" + suffix), sides = file.integers("side_ss" + suffix);
        if (elements.size() != sides.size()) {
            file.fail("side_ss" + suffix, "has not as many entries as 'elem_ss" + suffix + "'");
        }
        for (std::size_t i = 0; i < elements.size(); ++i) {
            add_side(file, elements[i], sides[i], group);
        }
    }
}

void Mesh::add_side(const NetCdf& file, std::int64_t element, std::int64_t side, std::int32_t group) {
    if (element < 1 || static_cast<std::uint64_t>(element) > m_n_in_file) {
        file.fail("elem_ss", "names element " + std::to_string(element) + ", which does not exist");
    }
    const auto in_file = static_cast<std::uint64_t>(element - 1);
    for (const Block& block : m_blocks) {
        if (in_file < block.first_in_file || in_file - block.first_in_file >= block.n_elements) {
            continue;
        }
        const std::uint64_t own = block.first_element + (in_file - block.first_in_file);
        const Topology topology = block.type.topology;
        // Sides 1 and 2 of shells are their faces, which are no boundary of a surface; their edges come behind.
        const std::span<const int> corners = side_corners(topology, block.is_shell ? side - 2 : side);
        const auto shape = elvis_cgns::shape(topology);
        const std::span<const int> of_file = elvis_cgns::source_corners(topology);
        for (int face = 0; face < elvis::native::n_faces(shape); ++face) {
            const std::span<const int> own_corners = elvis::native::face_corners(shape, face);
            const bool is_same =
                own_corners.size() == corners.size() && std::ranges::all_of(own_corners, [&](int corner) {
                    return std::ranges::find(corners, of_file[static_cast<std::size_t>(corner)]) != corners.end();
                });
            if (is_same) {
                m_face_groups.try_emplace(8 * own + static_cast<std::uint64_t>(face), group);
            }
        }
        return;
    }
}

const Block& Mesh::block_of(std::uint64_t element) const {
    const auto after = std::ranges::upper_bound(m_blocks, element, {}, &Block::first_element);
    return *std::prev(after);
}

std::span<const std::uint32_t> Mesh::nodes(std::uint64_t element) const {
    const Block& block = block_of(element);
    const std::size_t n = block.nodes.size() / block.n_elements;
    return std::span(block.nodes).subspan((element - block.first_element) * n, n);
}

std::int32_t Mesh::face_group(std::uint64_t element, int face) const {
    const auto found = m_face_groups.find(8 * element + static_cast<std::uint64_t>(face));
    return found == m_face_groups.end() ? ELVIS_GROUP_NONE : found->second;
}

} // namespace elvis_exodus
