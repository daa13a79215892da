#include <core/convert/topology/face_list.hpp>

#include <algorithm>
#include <vector>

namespace elvis {

namespace {

constexpr std::size_t faces_at_once = 1u << 18;
constexpr std::uint64_t elements_read_at_once = 16384;

native::Face face_of(const Topology& topology, std::uint64_t element, int local, std::int32_t group) {
    const auto at = static_cast<std::size_t>(local);
    native::Face face;
    face.element = static_cast<std::int64_t>(element);
    face.local_face = local;
    face.group = group;
    if (topology.is_shared(element, local)) {
        face.neighbour = topology.neighbour[element][at];
        face.neighbour_local_face = topology.neighbour_face[element][at];
    } else {
        const bool is_boundary = topology.neighbour[element][at] == Topology::no_neighbour;
        face.neighbour = is_boundary ? ELVIS_NEIGHBOUR_NONE : ELVIS_NEIGHBOUR_UNKNOWN;
    }
    return face;
}

} // namespace

void list_faces(const SourceVolume& source, const Topology& topology, const TaskControl& control,
                const std::function<void(std::span<const native::Face>)>& take) {
    std::vector<native::Face> faces;
    std::vector<elvis_source_element> elements;
    const std::uint64_t n_elements = topology.shapes.size();
    for (std::uint64_t element = 0; element < n_elements; ++element) {
        if (element % elements_read_at_once == 0) {
            control.check();
            elements.resize(std::min(elements_read_at_once, n_elements - element));
            source.elements(element, elements.size(), elements);
        }
        const elvis_source_element& its = elements[element % elements_read_at_once];
        for (int local = 0; local < native::n_faces(static_cast<native::Shape>(topology.shapes[element])); ++local) {
            const bool is_other_side =
                topology.is_shared(element, local) && topology.other_side(element, local) < face_side(element, local);
            if (!is_other_side) {
                faces.push_back(face_of(topology, element, local, its.face_groups[local]));
            }
        }
        if (faces.size() >= faces_at_once) {
            take(faces);
            faces.clear();
        }
    }
    take(faces);
}

} // namespace elvis
