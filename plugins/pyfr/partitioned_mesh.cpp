#include "partitioned_mesh.hpp"

#include <algorithm>

namespace elvis_pyfr {

namespace {

/** Faces that are read at a time. */
constexpr std::uint64_t connection_block = 65536;

} // namespace

PartitionedMesh::PartitionedMesh(elvis::hdf5::File file, std::string uuid) : Mesh(std::move(file), std::move(uuid)) {
    for (const Kind& kind : kinds()) {
        add_parts(kind);
    }
    check_sets();
    for (const std::string& name : m_file.names("/")) {
        constexpr std::string_view prefix = "bcon_";
        const auto [front, partition] = split_partition(name);
        if (partition >= 0 && front.starts_with(prefix)) {
            add_boundary(name, front.substr(prefix.size()), partition);
        }
    }
    std::ranges::stable_sort(m_boundary, {}, &BoundaryFace::element);
}

void PartitionedMesh::add_parts(const Kind& kind) {
    std::vector<Part> parts = find_parts(m_file, "spt_", kind, 1);
    if (parts.empty()) {
        return;
    }
    const std::vector<std::uint64_t>& shape = parts.front().data.shape();
    const auto dimension = static_cast<std::uint64_t>(elvis::native::dimension(kind.shape));
    if (shape[2] != dimension) {
        m_file.fail(parts.front().name,
                    "has points of " + std::to_string(shape[2]) + " coordinates instead of " + std::to_string(dimension));
    }
    const int order = elvis::nodal::order_of(kind.shape, shape[0], most_order(kind));
    if (order < 1) {
        m_file.fail(parts.front().name, "has elements of " + std::to_string(shape[0]) +
                                            " nodes, which is the number of no order from 1 to " +
                                            std::to_string(most_order(kind)));
    }
    add_set(kind, elvis_pyfr::n_elements(parts), shape_nodes(kind, static_cast<std::uint32_t>(order)), parts.front().name);
    m_sets.back().parts = sizes(parts);
    m_parts.emplace(&kind, std::move(parts));
}

void PartitionedMesh::add_boundary(const std::string& name, const std::string& group_name, std::int64_t partition) {
    const elvis::hdf5::Dataset data = m_file.dataset(name);
    const std::vector<std::string> members = data.members({});
    if (data.shape().size() != 1 || members.size() < 3) {
        m_file.fail(name, "is no list of faces");
    }
    const std::int32_t index = group(group_name);
    const std::uint64_t n = data.shape()[0];
    for (std::uint64_t first = 0; first < n; first += connection_block) {
        const std::uint64_t count = std::min(connection_block, n - first);
        const std::vector<std::string> names = data.read_texts(first, count, {members[0]});
        std::vector<std::int64_t> elements(count), faces(count);
        data.read({first}, {count}, std::span(elements), {members[1]});
        data.read({first}, {count}, std::span(faces), {members[2]});
        for (std::uint64_t at = 0; at < count; ++at) {
            const auto refuse = [&](const std::string& what) {
                m_file.fail(name, "has face " + std::to_string(first + at) + " of " + what);
            };
            const auto set = std::ranges::find(m_sets, names[at], [](const ElementSet& one) { return one.kind->name; });
            if (set == m_sets.end()) {
                refuse("a '" + names[at] + "', of which the mesh has none");
            }
            const std::vector<Part>& parts = m_parts.at(set->kind);
            const auto part = std::ranges::find(parts, partition, &Part::partition);
            if (part == parts.end() || elements[at] < 0 || static_cast<std::uint64_t>(elements[at]) >= part->count) {
                refuse("element " + std::to_string(elements[at]) + ", which the partition does not have");
            }
            if (faces[at] < 0 || faces[at] >= set->kind->n_faces) {
                refuse("local number " + std::to_string(faces[at]));
            }
            m_boundary.push_back({set->first + part->first + static_cast<std::uint64_t>(elements[at]), faces[at], index});
        }
    }
}

std::vector<double> PartitionedMesh::read_nodes(const ElementSet& set, std::uint64_t first, std::uint64_t count) const {
    const std::size_t n_nodes = set.nodes->size();
    std::vector<double> all(3 * n_nodes * count, 0.0), block;
    for_each_part_in(m_parts.at(set.kind), first, count,
                     [&](const Part& part, std::uint64_t from, std::uint64_t n, std::uint64_t offset) {
                         const std::uint64_t dimension = part.data.shape()[2];
                         block.resize(n_nodes * n * dimension);
                         part.data.read({0, from, 0}, {n_nodes, n, dimension}, std::span(block));
                         for (std::size_t node = 0; node < n_nodes; ++node) {
                             for (std::uint64_t element = 0; element < n; ++element) {
                                 std::copy_n(&block[(node * n + element) * dimension], dimension,
                                             &all[3 * ((offset + element) * n_nodes + node)]);
                             }
                         }
                     });
    return all;
}

Topology PartitionedMesh::read_topology(const ElementSet& set, std::uint64_t first, std::uint64_t count) const {
    const auto n_faces = static_cast<std::size_t>(set.kind->n_faces);
    Topology topology;
    topology.groups.assign(count * n_faces, -1);
    const std::uint64_t from = set.first + first;
    auto face = std::ranges::lower_bound(m_boundary, from, {}, &BoundaryFace::element);
    for (; face != m_boundary.end() && face->element < from + count; ++face) {
        topology.groups[(face->element - from) * n_faces + static_cast<std::size_t>(face->face)] = face->group;
    }
    return topology;
}

} // namespace elvis_pyfr
