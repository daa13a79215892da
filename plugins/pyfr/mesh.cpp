#include "mesh.hpp"

#include "mesh_file.hpp"
#include "partitioned_mesh.hpp"

#include <plugins/nodal/linear_element.hpp>

#include <algorithm>
#include <stdexcept>

namespace elvis_pyfr {

std::uint64_t Mesh::n_elements() const { return m_sets.back().first + m_sets.back().count; }

std::uint32_t Mesh::dimension() const {
    return static_cast<std::uint32_t>(elvis::native::dimension(m_sets.front().kind->shape));
}

void Mesh::add_set(const Kind& kind, std::uint64_t count, std::vector<double> nodes, const std::string& place) {
    const int order = elvis::nodal::order_of(kind.shape, nodes.size() / 3, most_order(kind));
    if (order < 1) {
        m_file.fail(place, "has elements of " + std::to_string(nodes.size() / 3) +
                               " nodes, which is the number of no order from 1 to " + std::to_string(most_order(kind)));
    }
    ElementSet set{.kind = &kind,
                   .first = m_sets.empty() ? 0 : n_elements(),
                   .count = count,
                   .nodes = nullptr,
                   .corners = elvis::nodal::corner_nodes(kind.shape, nodes),
                   .parts = {}};
    if (set.corners.empty()) {
        m_file.fail(place, "has nodes that are not at all corners");
    }
    try {
        set.nodes =
            std::make_shared<const elvis::nodal::NodalSpace>(kind.shape, static_cast<std::uint32_t>(order), std::move(nodes));
    } catch (const std::invalid_argument& error) {
        m_file.fail(place, std::string("has ") + error.what());
    }
    m_sets.push_back(std::move(set));
}

std::int32_t Mesh::group(const std::string& name) {
    const auto found = std::ranges::find(m_groups, name);
    const auto index = static_cast<std::int32_t>(found - m_groups.begin());
    if (found == m_groups.end()) {
        m_groups.push_back(name);
    }
    return index;
}

void Mesh::check_sets() const {
    if (m_sets.empty() || n_elements() == 0) {
        m_file.fail("", "has no elements");
    }
    for (const ElementSet& set : m_sets) {
        if (static_cast<std::uint32_t>(elvis::native::dimension(set.kind->shape)) != dimension()) {
            m_file.fail("", "has elements of two and of three dimensions");
        }
    }
}

bool is_mesh(const elvis::hdf5::File& file) {
    return file.has("eles") ||
           std::ranges::any_of(file.names("/"), [](const std::string& name) { return name.starts_with("spt_"); });
}

std::string find_uuid(const elvis::hdf5::File& file) {
    for (const char* const name : {"mesh-uuid", "mesh_uuid"}) {
        if (file.has(name)) {
            return file.text(name);
        }
    }
    return {};
}

int find_layout(const elvis::hdf5::File& file) {
    if (!file.has("version")) {
        return 0;
    }
    const std::int64_t version = file.integer("version");
    if (version < 1 || version > 2) {
        file.fail("version", "is " + std::to_string(version) + "; versions 1 and 2 are read");
    }
    return static_cast<int>(version);
}

std::unique_ptr<const Mesh> open_mesh(elvis::hdf5::File file) {
    const std::string uuid = find_uuid(file);
    if (uuid.empty()) {
        file.fail("mesh-uuid", "is missing");
    }
    if (find_layout(file) == 0) {
        return std::make_unique<PartitionedMesh>(std::move(file), uuid);
    }
    return std::make_unique<MeshFile>(std::move(file), uuid);
}

} // namespace elvis_pyfr
