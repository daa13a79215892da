#include "mesh_file.hpp"

#include <algorithm>

namespace elvis_pyfr {

namespace {

/** Nodes that are read at a time. */
constexpr std::uint64_t block_size = 262144;

} // namespace

MeshFile::MeshFile(elvis::hdf5::File file, std::string uuid) : Mesh(std::move(file), std::move(uuid)) {
    for (const Kind& kind : kinds()) {
        if (m_file.has("eles/" + std::string(kind.name))) {
            add_elements(kind);
        }
    }
    check_sets();
    read_positions();
    constexpr std::string_view prefix = "bc/";
    for (const std::string& code : m_file.texts("codec")) {
        m_group_of_code.push_back(code.starts_with(prefix) ? group(code.substr(prefix.size())) : -1);
    }
}

void MeshFile::read_positions() {
    const elvis::hdf5::Dataset data = m_file.dataset("nodes");
    if (data.shape().size() != 1 || !data.has({"location"}) || data.entry_size({"location"}) != dimension()) {
        m_file.fail("nodes", "has no member 'location' of " + std::to_string(dimension()) + " coordinates");
    }
    const std::uint64_t n = data.shape()[0];
    m_nodes.assign(3 * n, 0.0);
    std::vector<double> block;
    for (std::uint64_t first = 0; first < n; first += block_size) {
        const std::uint64_t count = std::min(block_size, n - first);
        block.resize(count * dimension());
        data.read({first}, {count}, std::span(block), {"location"});
        for (std::uint64_t node = 0; node < count; ++node) {
            std::copy_n(&block[node * dimension()], dimension(), &m_nodes[3 * (first + node)]);
        }
    }
}

void MeshFile::add_elements(const Kind& kind) {
    const std::string name = "eles/" + std::string(kind.name);
    elvis::hdf5::Dataset data = m_file.dataset(name);
    const auto dimension = static_cast<std::size_t>(elvis::native::dimension(kind.shape));
    if (data.shape().size() != 1 || !data.has({"nodes"}) || !data.has({"faces", "cidx"})) {
        m_file.fail(name, "has no members 'nodes' and 'faces.cidx'");
    }
    const std::vector<double> points = m_file.numbers_of_attribute(name, "pts");
    if (data.entry_size({"nodes"}) * dimension != points.size()) {
        m_file.fail(name, "has " + std::to_string(data.entry_size({"nodes"})) + " nodes an element and " +
                              std::to_string(points.size()) + " coordinates of shape points");
    }
    if (data.entry_size({"faces", "cidx"}) != static_cast<std::size_t>(kind.n_faces)) {
        m_file.fail(name, "has " + std::to_string(data.entry_size({"faces", "cidx"})) + " faces an element");
    }
    add_set(kind, data.shape()[0], to_native(kind, points), name);
    m_elements.emplace(&kind, std::move(data));
}

std::vector<std::int64_t> MeshFile::read_numbers(const ElementSet& set, std::uint64_t first, std::uint64_t count) const {
    const std::size_t n_nodes = set.nodes->size();
    std::vector<std::int64_t> numbers(count * n_nodes);
    const elvis::hdf5::Dataset& data = m_elements.at(set.kind);
    data.read({first}, {count}, std::span(numbers), {"nodes"});
    for (std::size_t at = 0; at < numbers.size(); ++at) {
        if (numbers[at] < 0 || static_cast<std::uint64_t>(numbers[at]) >= m_nodes.size() / 3) {
            data.fail("has node " + std::to_string(numbers[at]) + " in element " + std::to_string(first + at / n_nodes) +
                      "; the mesh has " + std::to_string(m_nodes.size() / 3));
        }
    }
    return numbers;
}

std::vector<double> MeshFile::read_nodes(const ElementSet& set, std::uint64_t first, std::uint64_t count) const {
    const std::vector<std::int64_t> numbers = read_numbers(set, first, count);
    std::vector<double> positions(3 * numbers.size());
    for (std::size_t at = 0; at < numbers.size(); ++at) {
        std::copy_n(&m_nodes[3 * static_cast<std::size_t>(numbers[at])], 3, &positions[3 * at]);
    }
    return positions;
}

Topology MeshFile::read_topology(const ElementSet& set, std::uint64_t first, std::uint64_t count) const {
    const std::vector<std::int64_t> numbers = read_numbers(set, first, count);
    Topology topology;
    for (std::uint64_t element = 0; element < count; ++element) {
        for (const std::size_t node : set.corners) {
            topology.corners.push_back(numbers[element * set.nodes->size() + node]);
        }
    }
    std::vector<std::int64_t> codes(count * static_cast<std::size_t>(set.kind->n_faces));
    const elvis::hdf5::Dataset& data = m_elements.at(set.kind);
    data.read({first}, {count}, std::span(codes), {"faces", "cidx"});
    for (const std::int64_t code : codes) {
        if (code < 0 || static_cast<std::size_t>(code) >= m_group_of_code.size()) {
            data.fail("refers to entry " + std::to_string(code) + " of the codec, which has " +
                      std::to_string(m_group_of_code.size()));
        }
        topology.groups.push_back(m_group_of_code[static_cast<std::size_t>(code)]);
    }
    return topology;
}

} // namespace elvis_pyfr
