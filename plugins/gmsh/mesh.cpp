#include "mesh.hpp"

#include "basis.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace gmsh {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& what) {
    throw elvis::api::Error(ELVIS_ERROR_FORMAT, path, what);
}

/** Nodes of all elements by position. */
std::vector<std::uint32_t> resolve_nodes(const FileMesh& file, const TagIndex& index, const std::string& path) {
    std::vector<std::uint32_t> nodes;
    nodes.reserve(file.element_nodes.size());
    std::size_t at = 0;
    for (std::size_t element = 0; element < file.element_tags.size(); ++element) {
        for (const std::size_t end = at + n_nodes(file.element_types[element]); at < end; ++at) {
            const std::optional<std::uint32_t> node = index.find(file.element_nodes[at]);
            if (!node) {
                fail(path, "element " + std::to_string(file.element_tags[element]) + " has node " +
                               std::to_string(file.element_nodes[at]) + ", which $Nodes does not hold");
            }
            nodes.push_back(*node);
        }
    }
    return nodes;
}

} // namespace

Mesh::Mesh(FileMesh&& file, const std::string& path, const elvis::api::Host& host) {
    m_node_index = TagIndex(file.node_tags);
    if (m_node_index.repeated()) {
        fail(path, "node " + std::to_string(*m_node_index.repeated()) + " is given twice");
    }
    m_positions = std::move(file.positions);
    const std::vector<std::uint32_t> nodes = resolve_nodes(file, m_node_index, path);
    int largest = 0;
    for (const ElementType& type : file.element_types) {
        largest = std::max(largest, gmsh::dimension(type.topology));
    }
    if (largest < 2) {
        fail(path, "there are no elements of two or three dimensions");
    }
    m_dimension = largest;

    std::size_t at = 0;
    for (std::size_t element = 0; element < file.element_tags.size(); ++element) {
        const ElementType& type = file.element_types[element];
        const std::size_t n = gmsh::n_nodes(type);
        m_converted.push_back(nothing);
        if (gmsh::dimension(type.topology) == m_dimension) {
            if (!has_lagrange_basis(type)) {
                fail(path, "element " + std::to_string(file.element_tags[element]) + " is a " + name(type) +
                               " of serendipity kind, for which Gmsh defines no interpolation");
            }
            m_converted.back() = static_cast<std::uint32_t>(m_types.size());
            keep_element(type, {nodes.data() + at, n});
        }
        at += n;
    }
    drop_copies(path);
    m_element_index = TagIndex(file.element_tags);
    for (std::size_t element = 0; m_element_index.repeated() && element < file.element_tags.size(); ++element) {
        const std::uint64_t tag = file.element_tags[element];
        if (m_converted[element] != nothing && m_converted[*m_element_index.find(tag)] != m_converted[element]) {
            fail(path, "two elements have the tag " + std::to_string(tag));
        }
    }
    collect_groups(file, nodes, host);
}

void Mesh::keep_element(const ElementType& type, std::span<const std::uint32_t> nodes) {
    m_types.push_back(type);
    m_nodes.insert(m_nodes.end(), nodes.begin(), nodes.end());
    m_first_node.push_back(m_nodes.size());
}

/** MSH 2.2 repeats an element for each of its physical groups. */
void Mesh::drop_copies(const std::string& path) {
    std::vector<std::uint32_t> order(n_elements());
    std::iota(order.begin(), order.end(), 0u);
    const auto less = [&](std::uint32_t a, std::uint32_t b) {
        const int difference = static_cast<int>(std::ranges::lexicographical_compare(nodes(b), nodes(a))) -
                               static_cast<int>(std::ranges::lexicographical_compare(nodes(a), nodes(b)));
        return difference != 0 ? difference < 0 : a < b;
    };
    std::ranges::sort(order, less);
    // Of each run of equal elements the first in the file stays.
    std::vector<std::uint32_t> original(n_elements());
    bool has_copies = false;
    for (std::size_t index = 0; index < order.size(); ++index) {
        const bool is_copy = index > 0 && std::ranges::equal(nodes(order[index]), nodes(order[index - 1]));
        original[order[index]] = is_copy ? original[order[index - 1]] : order[index];
        has_copies = has_copies || is_copy;
        if (is_copy && type(order[index]) != type(order[index - 1])) {
            fail(path, "two elements of different types have the same nodes");
        }
    }
    if (!has_copies) {
        return;
    }
    const std::vector<ElementType> types = std::move(m_types);
    const std::vector<std::size_t> first_node = std::move(m_first_node);
    const std::vector<std::uint32_t> all_nodes = std::move(m_nodes);
    m_types.clear();
    m_first_node = {0};
    m_nodes.clear();
    std::vector<std::uint32_t> renumbered(types.size());
    for (std::size_t element = 0; element < types.size(); ++element) {
        renumbered[element] = static_cast<std::uint32_t>(m_types.size());
        if (original[element] == element) {
            keep_element(types[element], {all_nodes.data() + first_node[element], all_nodes.data() + first_node[element + 1]});
        }
    }
    for (std::uint32_t& element : m_converted) {
        element = element == nothing ? nothing : renumbered[original[element]];
    }
}

Mesh::FaceKey Mesh::face_key(std::span<const std::uint32_t> nodes) const {
    FaceKey key;
    key.fill(nothing);
    std::ranges::copy(nodes, key.begin());
    std::ranges::sort(key);
    return key;
}

void Mesh::collect_groups(const FileMesh& file, std::span<const std::uint32_t> nodes, const elvis::api::Host& host) {
    const int face_dimension = m_dimension - 1;
    // Groups with elements, in the order of their tags.
    std::set<std::int32_t> tags;
    std::vector<std::pair<FaceKey, std::int32_t>> found;
    std::size_t at = 0;
    for (std::size_t element = 0; element < file.element_tags.size(); ++element) {
        const ElementType& type = file.element_types[element];
        const std::size_t n = gmsh::n_nodes(type);
        if (gmsh::dimension(type.topology) == face_dimension) {
            const std::int32_t label = file.element_labels[element];
            std::vector<std::int32_t> of_element{label};
            if (file.labels_are_entities) {
                const auto entry = file.entity_groups.find({face_dimension, label});
                of_element = entry == file.entity_groups.end() ? std::vector<std::int32_t>{} : entry->second;
            }
            for (const std::int32_t tag : of_element) {
                if (tag != 0) {
                    tags.insert(tag);
                    found.emplace_back(face_key(nodes.subspan(at, static_cast<std::size_t>(n_corners(type.topology)))), tag);
                }
            }
        }
        at += n;
    }
    std::set<std::string> taken;
    for (const std::int32_t tag : tags) {
        const auto named = file.group_names.find({face_dimension, tag});
        std::string name = named != file.group_names.end() && !named->second.empty()
                               ? named->second
                               : (m_dimension == 3 ? "surface " : "curve ") + std::to_string(tag);
        if (!taken.insert(name).second) {
            name += " (" + std::to_string(tag) + ")";
            taken.insert(name);
        }
        m_groups.push_back(std::move(name));
    }
    const auto key_less = [](const auto& a, const auto& b) { return a.first < b.first; };
    std::ranges::stable_sort(found, key_less);
    std::size_t n_shared = 0;
    for (const auto& [key, tag] : found) {
        const auto group = static_cast<std::int32_t>(std::distance(tags.begin(), tags.find(tag)));
        if (!m_faces.empty() && m_faces.back().key == key) {
            n_shared += m_faces.back().group != group ? 1 : 0;
        } else {
            m_faces.push_back({key, group});
        }
    }
    if (n_shared > 0) {
        host.log(ELVIS_LOG_WARNING, std::to_string(n_shared) +
                                        " faces are in several physical groups; each is kept in the first that the file gives");
    }
}

std::array<std::int32_t, 6> Mesh::face_groups(std::size_t element) const {
    std::array<std::int32_t, 6> groups;
    groups.fill(ELVIS_GROUP_NONE);
    if (m_faces.empty()) {
        return groups;
    }
    const Topology topology = m_types[element].topology;
    const elvis::native::Shape native = shape(topology);
    const std::span<const std::uint32_t> of_element = nodes(element);
    for (int face = 0; face < elvis::native::n_faces(native); ++face) {
        std::array<std::uint32_t, 4> corners{};
        std::size_t n = 0;
        for (const int corner : elvis::native::face_corners(native, face)) {
            corners[n++] = of_element[static_cast<std::size_t>(source_corners(topology)[static_cast<std::size_t>(corner)])];
        }
        const FaceKey key = face_key({corners.data(), n});
        const auto found = std::ranges::lower_bound(m_faces, key, {}, &GroupedFace::key);
        if (found != m_faces.end() && found->key == key) {
            groups[static_cast<std::size_t>(face)] = found->group;
        }
    }
    return groups;
}

std::optional<std::uint32_t> Mesh::find_element(std::uint64_t tag) const {
    const std::optional<std::uint32_t> at = m_element_index.find(tag);
    return at && m_converted[*at] != nothing ? std::optional(m_converted[*at]) : std::nullopt;
}

} // namespace gmsh
