#include "boundary_groups.hpp"

#include <elvis/native/space.hpp>

#include <algorithm>
#include <map>

namespace elvis_mfem {

BoundaryGroups::BoundaryGroups(const Mesh& mesh, const std::vector<bool>& is_left_out) {
    // Attributes ascending, so that the groups' order does not depend on that of the elements.
    std::map<int, std::string> name_of;
    std::vector<BoundaryElement> boundary;
    for (std::size_t index = 0; index < mesh.boundary.size(); ++index) {
        if (!is_left_out[index]) {
            boundary.push_back(mesh.boundary[index]);
        }
    }
    for (const BoundaryElement& element : boundary) {
        name_of.try_emplace(element.attribute, "attribute " + std::to_string(element.attribute));
    }
    // An attribute may be in several sets: the smallest says most about it.
    std::vector<const AttributeSet*> sets;
    for (const AttributeSet& set : mesh.boundary_sets) {
        sets.push_back(&set);
    }
    std::ranges::stable_sort(sets, std::ranges::greater(), [](const AttributeSet* set) { return set->attributes.size(); });
    for (const AttributeSet* set : sets) {
        for (int attribute : set->attributes) {
            const auto found = name_of.find(attribute);
            if (found != name_of.end() && !set->name.empty()) {
                found->second = set->name;
            }
        }
    }
    std::map<int, std::int32_t> group_of;
    for (const auto& [attribute, name] : name_of) {
        const auto found = std::ranges::find(m_names, name);
        group_of[attribute] = static_cast<std::int32_t>(found - m_names.begin());
        if (found == m_names.end()) {
            m_names.push_back(name);
            m_attributes.push_back(attribute);
        }
    }
    for (const BoundaryElement& element : boundary) {
        VertexKey key = element.vertices;
        std::ranges::sort(key);
        m_groups.emplace(key, group_of[element.attribute]);
    }
}

std::int32_t BoundaryGroups::of_face(const MeshElement& element, int local_face) const {
    const auto shape = static_cast<elvis::native::Shape>(elvis_mfem::shape(element.geometry));
    const auto corners = corner_vertices(element.geometry);
    VertexKey key{-1, -1, -1, -1};
    std::size_t n = 0;
    for (int corner : elvis::native::face_corners(shape, local_face)) {
        key[n++] = element.vertices[static_cast<std::size_t>(corners[static_cast<std::size_t>(corner)])];
    }
    std::ranges::sort(key);
    const auto found = m_groups.find(key);
    return found == m_groups.end() ? ELVIS_GROUP_NONE : found->second;
}

} // namespace elvis_mfem
